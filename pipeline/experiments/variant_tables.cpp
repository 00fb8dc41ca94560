// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/variant_tables.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include <fmt/core.h>

#include "geometry/foundation/units.h"
#include "multibody/joints/joint_kinds.h"
#include "pipeline/experiments/bending_plane.h"
#include "pipeline/experiments/case_model.h"
#include "pipeline/experiments/rigid_neck.h"
#include "pipeline/language/study/origins.h"

namespace flexneck::pipeline {

namespace {

const PendulumEntry& base_of(const std::vector<PendulumEntry>& entries,
                             const PendulumEntry& variant) {
  return *std::find_if(entries.begin(), entries.end(), [&](const PendulumEntry& entry) {
    return entry.experiment.name == variant.experiment.variant_of;
  });
}

/// Names of the variants in order of first appearance.
std::vector<std::string> variant_names(const std::vector<PendulumEntry>& entries) {
  std::vector<std::string> names;
  for (const PendulumEntry& entry : entries) {
    const std::string& name = entry.experiment.variant;
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  }
  return names;
}

/// A figure of a case, shown beside that of its base case.
struct CaseFigure {
  const char* name;
  const char* unit;
  const char* format;
  double factor;  ///< from SI to the unit
  std::optional<double> (*of)(const PendulumEntry&);
};

std::vector<CaseFigure> case_figures() {
  const double deg = factor_from_si("rad", "deg");
  const double gn = factor_from_si("m/s^2", "gn");
  const double lbf_ft = factor_from_si("N*m", "lbf*ft");
  using Entry = PendulumEntry;
  using Figure = std::optional<double>;
  return {
      {"head rotation", "deg", "{:.1f}", deg,
       [](const Entry& e) -> Figure { return e.result.head_rotation.value; }},
      {"at", "ms", "{:.1f}", 1e3,
       [](const Entry& e) -> Figure { return e.result.head_rotation.time_s; }},
      {"first zero crossing", "ms", "{:.1f}", 1e3,
       [](const Entry& e) -> Figure { return e.result.zero_crossing_s; }},
      {"neck rotation", "deg", "{:.1f}", deg,
       [](const Entry& e) -> Figure { return e.result.neck_rotation.value; }},
      {"head acceleration", "gn", "{:.1f}", gn,
       [](const Entry& e) -> Figure { return e.result.head_acceleration.value; }},
      {"occipital moment", "lbf*ft", "{:.1f}", lbf_ft,
       [](const Entry& e) -> Figure { return e.result.occipital_moment.value; }},
      {"eigenvalue", "Hz", "{:.2f}", 1,
       [](const Entry& e) -> Figure { return e.hanging.frequency_Hz; }},
      {"its damping", "1", "{:.3f}", 1,
       [](const Entry& e) -> Figure { return e.hanging.damping_ratio; }},
      {"run", "Hz", "{:.2f}", 1,
       [](const Entry& e) -> Figure { return e.result.run_frequency_Hz; }},
      {"its damping", "1", "{:.3f}", 1,
       [](const Entry& e) -> Figure { return e.result.run_damping_ratio; }},
  };
}

/// The revolute joint on which the head nods, if the case's model has one instead of a fixed joint.
const multibody::Joint* head_pin(const CaseSection& experiment) {
  const multibody::Model& model = experiment.model.model;
  for (const multibody::Joint& joint : model.joints)
    if (model.markers[joint.marker_j].name == "head.condyles")
      return joint.kind == &multibody::kRevoluteJoint ? &joint : nullptr;
  return nullptr;
}

/// Title of a variant's table, from the changes that it makes.
std::string title_of(const CaseSection& experiment, const CaseSection& base) {
  const std::string variant = "Variant '" + experiment.variant + "'";
  if (experiment.impact_velocity_m_s != base.impact_velocity_m_s)
    return variant + ", at another impact velocity, compared with the cases that it is based on";
  if (has_rigid_neck(experiment))
    return variant + ": rigid neck on two pivots, compared with the deformable neck";
  if (head_pin(experiment) != nullptr)
    return variant + ": head on a pin joint with a spring, compared with a fixed head";
  if (experiment.arm == CaseSection::Arm::rotating)
    return "Rotating arm compared with a translating arm";
  if (experiment.pulse_scaling == PulseFit::duration)
    return "Pulse scaled in duration, compared with a pulse scaled in amplitude";
  return variant + " compared with the cases that it is based on";
}

/// Origin of the pivot's distance: by the variant, else by its base case, else by all cases.
std::string pivot_origin(const Study& study, const CaseSection& experiment) {
  const std::string key = "pivot_distance";
  for (const std::string& table :
       {"variant." + experiment.variant, "case." + experiment.variant_of})
    if (std::string origin = origins_of(study.parameters, table, {key}); !origin.empty())
      return origin;
  return origins_of(study.parameters, "pendulum", {key});
}

std::vector<std::string> notes_of(const Study& study, const CaseSection& experiment) {
  std::vector<std::string> notes = {
      "(baseline): the same figure of the case that the variant is based on."};
  if (has_rigid_neck(experiment)) {
    notes.push_back(
        "Neither the parameters of the paper's rigid model nor the curves of its tests are "
        "published; the table shows how much the models differ, not which is closer to a real "
        "neck.");
    notes.push_back(
        "If the springs of a pivot differ in the two directions, small motions are computed with "
        "the side to which the head hangs.");
  }
  if (!has_rigid_neck(experiment) && head_pin(experiment) != nullptr) {
    notes.push_back("Origin of the spring according to the study: " +
                    origins_of(study.parameters, "variant." + experiment.made_by + ".resistance") +
                    ". The paper proposes to find its parameters by trial. In a lateral test the "
                    "pin does not move, since its axis lies in the plane of the test.");
    notes.push_back(
        "The paper: a system frequency of about 5 Hz and an effective damping of about 0.2; it "
        "ascribes a peak of the moment at about 50 ms, in flexion only, to the nodding blocks.");
  }
  if (experiment.arm == CaseSection::Arm::rotating)
    notes.push_back(
        "A case with a rotating arm starts from the undeformed neck, since there is no equilibrium "
        "while the arm swings. Origin of the distance of the neck from the pivot according to the "
        "study: " +
        pivot_origin(study, experiment) + ".");
  return notes;
}

/// Table of a variant: each figure of its cases, next to that of their base cases.
ResultTable variant_table(const Study& study, const std::string& name,
                          const std::vector<PendulumEntry>& entries) {
  const std::vector<CaseFigure> figures = case_figures();
  ResultTable table;
  table.name = "variant-" + name;
  table.columns = {{"case", ""}};
  for (const CaseFigure& figure : figures)
    table.columns.insert(table.columns.end(),
                         {{figure.name, figure.unit}, {"(baseline)", figure.unit}});
  for (const PendulumEntry& entry : entries) {
    if (entry.experiment.variant != name) continue;
    if (table.rows.empty()) {
      table.title = title_of(entry.experiment, base_of(entries, entry).experiment);
      table.notes = notes_of(study, entry.experiment);
    }
    std::vector<std::string> row = {entry.experiment.name};
    for (const CaseFigure& figure : figures)
      for (const PendulumEntry* const shown : {&entry, &base_of(entries, entry)})
        row.push_back(text_of(figure.of(*shown), figure.format, figure.factor));
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

std::vector<ResultTable> variant_tables(const Study& study,
                                        const std::vector<PendulumEntry>& entries) {
  const std::vector<std::string> names = variant_names(entries);
  std::vector<ResultTable> tables;
  tables.reserve(names.size());
  for (const std::string& name : names) tables.push_back(variant_table(study, name, entries));
  return tables;
}

namespace {

/// Secant stiffness at an angle of 0.001 rad, N m/rad.
double small_stiffness(const multibody::ResistanceSide& side) {
  constexpr double kSmall = 1e-3;
  return side.load(kSmall) / kSmall;
}

std::vector<std::string> rigid_row(const std::string& name, const std::string& plane,
                                   const RigidNeck& neck) {
  const double in = factor_from_si("m", "in");
  const double stiffness = factor_from_si("N*m/rad", "in*lbf/deg");
  const double damping = factor_from_si("N*m*s/rad", "in*lbf*s/deg");
  std::vector<std::string> row = {
      name, plane, fmt::format("{:.3f}", neck.rigid.mass_kg * factor_from_si("kg", "lb"))};
  for (const RigidNeck::Pivot* const pivot : {&neck.lower, &neck.upper}) {
    const multibody::Resistance& law = pivot->resistance;
    row.push_back(fmt::format("{:.3f}", pivot->height_m * in));
    row.push_back(fmt::format("{:.1f}", small_stiffness(law.positive) * stiffness));
    row.push_back(fmt::format("{:.1f}", small_stiffness(law.negative) * stiffness));
    row.push_back(fmt::format("{:.3f}", law.damping * damping));
  }
  return row;
}

}  // namespace

ResultTable rigid_neck_table(const Study& study, const fe_modal::ModalBody& body) {
  ResultTable table;
  table.name = "rigid necks";
  table.title = "Rigid necks: pivots, springs at small angles, dampers";
  table.columns = {{"neck", ""},
                   {"plane", ""},
                   {"mass", "lb"},
                   {"lower pivot", "in"},
                   {"flexion", "in*lbf/deg"},
                   {"extension", "in*lbf/deg"},
                   {"damper", "in*lbf*s/deg"},
                   {"upper pivot", "in"},
                   {"flexion", "in*lbf/deg"},
                   {"extension", "in*lbf/deg"},
                   {"damper", "in*lbf*s/deg"}};
  std::set<std::pair<std::string, bool>> seen;
  for (const CaseSection& experiment : study.cases) {
    if (experiment.kind != CaseSection::Kind::pendulum || !has_rigid_neck(experiment)) continue;
    const bool lateral = experiment.direction == CaseSection::Direction::lateral;
    const std::string& name = experiment.variant.empty() ? experiment.name : experiment.variant;
    if (!seen.insert({name, lateral}).second) continue;
    if (const std::optional<RigidNeck> neck = rigid_neck_in(case_model(experiment, body)))
      table.rows.push_back(rigid_row(name, lateral ? "lateral" : "fore-aft", *neck));
  }
  table.notes = {
      "Flexion and extension: in the lateral plane, bending to one side and to the other. "
      "Equivalent: link and springs with the same response to static loads at the top of the neck "
      "as the modes used, with their mass and the damping of the first mode."};
  return table;
}

ResultTable processor_table(const std::vector<PendulumEntry>& entries) {
  ResultTable table;
  table.name = "processor time";
  table.title = "Measured ratio of the processor times of the deformable and the rigid necks";
  table.columns = {{"case", ""},
                   {"rigid neck", ""},
                   {"deformable", "ms"},
                   {"rigid", "ms"},
                   {"ratio", "1"},
                   {"evaluations deformable", ""},
                   {"evaluations rigid", ""},
                   {"ratio", "1"}};
  std::map<std::string, std::array<double, 4>> sums;
  const auto add_row = [&](const std::string& name, const std::string& neck,
                           const std::array<double, 4>& figures) {
    const auto& [deformable_s, rigid_s, deformable, rigid] = figures;
    table.rows.push_back({name, neck, fmt::format("{:.2f}", deformable_s * 1e3),
                          fmt::format("{:.2f}", rigid_s * 1e3),
                          fmt::format("{:.1f}", deformable_s / rigid_s),
                          fmt::format("{:.0f}", deformable), fmt::format("{:.0f}", rigid),
                          fmt::format("{:.1f}", deformable / rigid)});
  };
  for (const PendulumEntry& entry : entries) {
    if (!has_rigid_neck(entry.experiment) || entry.experiment.variant_of.empty()) continue;
    const PendulumEntry& base = base_of(entries, entry);
    if (!base.cost || !entry.cost) continue;
    const std::array<double, 4> figures = {base.cost->processor_s, entry.cost->processor_s,
                                           static_cast<double>(base.cost->evaluations),
                                           static_cast<double>(entry.cost->evaluations)};
    add_row(base.experiment.name, entry.experiment.variant, figures);
    auto& sum = sums[entry.experiment.variant];
    for (std::size_t k = 0; k < figures.size(); ++k) sum[k] += figures[k];
  }
  for (const auto& [neck, figures] : sums) add_row("all", neck, figures);
  table.notes = {
      "Integration over the duration of the case with the tolerance of the study, with output only "
      "at the end, on one thread. Measured times differ from run to run; the numbers of "
      "evaluations of the equations of motion do not.",
      "According to the paper, the deformable model typically takes 2 to 6 times as long as the "
      "rigid one."};
  return table;
}

}  // namespace flexneck::pipeline
