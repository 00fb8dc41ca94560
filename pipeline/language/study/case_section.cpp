// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <utility>

#include "geometry/foundation/names.h"
#include "pipeline/language/document/channel_class.h"
#include "pipeline/language/study/drop.h"
#include "pipeline/language/study/sections.h"

namespace flexneck::pipeline {

namespace {

std::vector<std::string> case_kinds() { return {"pendulum", "static"}; }
std::vector<std::string> directions() { return {"flexion", "extension", "lateral", "oblique"}; }
std::vector<std::string> pulse_scalings() { return {"amplitude", "duration", "none"}; }
std::vector<std::string> arms() { return {"translating", "rotating"}; }

constexpr KeyDetails kAbove0 = {.range = kPositive};

/// Keys that [pendulum] and [static] may give for all cases of a kind.
constexpr auto kCaseKeys = std::to_array<Key>({
    Key::text("name", kRequired, "Name of the case"),
    Key::text("kind", kRequired, "Kind of experiment", {.choices = case_kinds}),
    Key::texts("bodies", kNone,
               "Bodies of the study in the model, with the joints between them (default: all)"),
    Key::text("direction", kRequired, "Direction of bending", {.choices = directions}),
    Key::quantity(
        "oblique_angle", "rad", kNone,
        "Angle of the direction oblique, which requires it, from forwards towards the left",
        {.range = {.low = -3.1416, .high = 3.1416}}),
    Key::quantity("duration", "s", kRequired, "Duration of the run", kAbove0),
    Key::texts("forces", kNone,
               "Forces, springs and resistances of the study that act in the case"),
    Key::quantity("drop_angle", "rad", kNone, "Angle from which the arm is released",
                  {.range = {.low = 0, .high = 3.1416, .has_low = false}}),
    Key::quantity("effective_length", "m", kNone,
                  "Length of the mathematical pendulum that is equivalent to the arm", kAbove0),
    Key::quantity("impact_velocity", "m/s", kNone,
                  "Impact velocity, instead of drop_angle and effective_length", kAbove0),
    Key::text("pulse", kRequired, "Pulse of the pendulum: the deceleration of its arm"),
    Key::text("pulse_scaling", "amplitude",
              "Quantity of the pulse that is scaled so that it stops the arm",
              {.choices = pulse_scalings}),
    Key::text("arm", "translating", "Motion of the arm during the pulse", {.choices = arms}),
    Key::quantity("pivot_distance", "m", kNone,
                  "Distance from the pivot of a rotating arm to the base of the neck", kAbove0),
    Key::quantity("accelerometer_distance", "m", kNone,
                  "Distance from the pivot of a rotating arm to the accelerometer that measures "
                  "velocity and pulse",
                  kAbove0),
    Key::quantity("moment_arm", "m", "0.0176784",
                  "Arm of the load cell's moment about the occipital condyles, M = My - arm Fx",
                  {.range = at_least(0)}),
    Key::text("force_filter", "CFC 600", "Channel frequency class of Fx in that moment",
              {.choices = channel_class_names}),
    Key::text("moment_filter", "CFC 600", "Channel frequency class of My in that moment",
              {.choices = channel_class_names}),
    Key::flag("equivalent_rigid_neck", "false",
              "Replace the deformable neck by a rigid link on two pivots with the same mass, "
              "static stiffness and damping"),
});

constexpr auto kVariantKeys = std::to_array<Key>({
    Key::texts("of", kRequired, "Cases that the variant is based on; a name may end in *"),
    Key::text("suffix", kNone,
              "Suffix of the names of its cases, which several variants may share (default: the "
              "variant's name)"),
});

/// Rotation of a hanging neck, the head below the arm: the neck's z is the world's -z, x is
/// unchanged.
Eigen::Quaterniond hanging() { return {0, 1, 0, 0}; }

void read_direction(const StudyTable& table, CaseSection& experiment) {
  using Direction = CaseSection::Direction;
  experiment.direction = static_cast<Direction>(table.choice("direction"));
  if (experiment.direction == Direction::oblique)
    experiment.oblique_angle_rad = table.quantity("oblique_angle");
  else
    table.refuse_given({"oblique_angle"}, "it belongs to direction = \"oblique\"");
}

void read_velocity(const StudyTable& table, CaseSection& experiment) {
  if (table.has("drop_angle")) {
    experiment.drop_angle_rad = table.quantity("drop_angle");
  }
  if (table.has("effective_length"))
    experiment.effective_length_m = table.quantity("effective_length");
  experiment.velocity_is_given = table.has("impact_velocity");
  if (experiment.velocity_is_given) {
    experiment.impact_velocity_m_s = table.quantity("impact_velocity");
  } else if (experiment.drop_angle_rad && experiment.effective_length_m) {
    experiment.impact_velocity_m_s =
        drop_velocity(*experiment.effective_length_m, *experiment.drop_angle_rad);
  } else {
    table.refuse("impact_velocity",
                 "expected this key, or a drop_angle and an effective_length to compute it from");
  }
}

MomentDefinition read_moment_definition(const StudyTable& table) {
  return {table.quantity("moment_arm"), read_channel_class(table, "force_filter"),
          read_channel_class(table, "moment_filter")};
}

void read_pendulum(const StudyTable& table, CaseSection& experiment) {
  read_velocity(table, experiment);
  experiment.pulse = table.text("pulse");
  experiment.pulse_scaling = static_cast<PulseFit>(table.choice("pulse_scaling"));
  experiment.arm = static_cast<CaseSection::Arm>(table.choice("arm"));
  for (const auto& [key, value] :
       {std::pair{"pivot_distance", &experiment.pivot_distance_m},
        std::pair{"accelerometer_distance", &experiment.accelerometer_distance_m}}) {
    if (table.has(key) || experiment.arm == CaseSection::Arm::rotating)
      *value = table.quantity(key);
  }
  experiment.moment = read_moment_definition(table);
  experiment.equivalent_rigid_neck = table.flag("equivalent_rigid_neck");
  if (experiment.equivalent_rigid_neck && experiment.direction == CaseSection::Direction::oblique)
    table.refuse(
        "equivalent_rigid_neck",
        "expected direction flexion, extension or lateral, since the pivots rotate about one axis");
}

/// A case's tables, which may contain its own bodies, joints and forces.
struct CaseSource {
  StudyTable table;  ///< all keys of the case
  CaseTables tables;
};

Assembly read_model(const CaseSource& source, const CaseSection& experiment,
                    const StudyModels& models) {
  // Marked as known here; their elements are read table by table.
  for (const Key& row : model_table_keys()) source.table.has(std::string(row.name));
  Assembly begun;
  begun.end_time_s = experiment.duration_s;
  const bool swings = experiment.kind == CaseSection::Kind::pendulum;
  if (swings) {
    begun.motion = Assembly::Motion::by_case;
    begun.rotation = hanging();
  }
  Assembly model = models.of_case(source.tables, std::move(begun));
  if (swings && model.prescribed.size() != 1)
    source.table.refuse("bodies",
                        "expected one body of kind \"prescribed\", the pendulum's arm, found " +
                            std::to_string(model.prescribed.size()));
  return model;
}

/// Reads a case without its model.
CaseSection read_case(CaseSource& source) {
  const StudyTable& table = source.table;
  CaseSection experiment;
  experiment.name = table.text("name");
  experiment.kind = static_cast<CaseSection::Kind>(table.choice("kind"));
  read_direction(table, experiment);
  experiment.duration_s = table.quantity("duration");
  if (experiment.kind == CaseSection::Kind::pendulum) read_pendulum(table, experiment);
  source.tables.bodies = table.texts("bodies");
  source.tables.forces = experiment.forces = table.texts("forces");
  return experiment;
}

/// Cases and the tables that they are read from.
struct ReadCases {
  std::vector<CaseSource> sources;
  std::vector<CaseSection> cases;

  void add(CaseSource source) {
    cases.push_back(read_case(source));
    sources.push_back(std::move(source));
  }
};

/// Adds the cases of a variant, in the order of their base cases.
/// @param own  number of cases that are not variants
void add_variants(const StudyTable& variant, std::size_t own, ReadCases& all) {
  std::vector<CaseSection>& cases = all.cases;
  const std::string name = variant.text("name");
  const std::string suffix = variant.has("suffix") ? variant.text("suffix") : name;
  for (const std::string& pattern : variant.texts("of")) {
    bool found = false;
    for (std::size_t k = 0; k < own; ++k) {
      const std::string of = cases[k].name;
      if (!fits(of, pattern)) continue;
      found = true;
      CaseSource merged{variant.over(all.sources[k].table), all.sources[k].tables};
      merged.tables.layers.push_back(variant);
      all.add(std::move(merged));
      CaseSection& made = cases.back();
      made.name = of + "-" + suffix;
      made.variant_of = of;
      made.variant = suffix;
      made.made_by = name;
    }
    std::vector<std::string> names;
    for (std::size_t k = 0; k < own; ++k) names.push_back(cases[k].name);
    if (!found)
      variant.refuse("of", "there is no case '" + pattern + "'" + did_you_mean(names, pattern));
  }
}

std::vector<Key> with_model_tables(std::span<const Key> own, std::span<const Key> more) {
  std::vector<Key> all(own.begin(), own.end());
  all.insert(all.end(), more.begin(), more.end());
  const std::vector<Key> tables = model_table_keys();
  all.insert(all.end(), tables.begin(), tables.end());
  return all;
}

}  // namespace

std::span<const Key> case_keys() {
  static const std::vector<Key> keys = with_model_tables(kCaseKeys, {});
  return keys;
}

std::span<const Key> variant_keys() {
  static const std::vector<Key> keys = with_model_tables(kCaseKeys, kVariantKeys);
  return keys;
}

std::vector<CaseSection> read_cases(const StudyTable& root, const StudyModels& models,
                                    CasesRead which) {
  const StudyTable pendulum = root.table("pendulum");
  const StudyTable tester = root.table("static");
  ReadCases all;
  for (const StudyTable& own : root.tables("case")) {
    const StudyTable& shared = own.choice("kind") == 0 ? pendulum : tester;
    all.add({own.over(shared), {.layers = {shared, own}, .bodies = {}, .forces = {}}});
  }
  const std::size_t own = all.cases.size();
  for (const StudyTable& variant : root.tables("variant")) add_variants(variant, own, all);
  std::vector<CaseSection>& cases = all.cases;
  const std::set<std::string> chosen = chosen_cases(root, cases);
  for (std::size_t k = 0; k < cases.size(); ++k) {
    if (which == CasesRead::chosen && !chosen.contains(cases[k].name)) continue;
    cases[k].model = read_model(all.sources[k], cases[k], models);
    all.sources[k].table.finish();
  }
  if (which == CasesRead::chosen) return cases;
  const auto is_there = [&](CaseSection::Kind kind) {
    for (const CaseSection& experiment : cases)
      if (experiment.kind == kind) return true;
    return false;
  };
  if (is_there(CaseSection::Kind::pendulum)) pendulum.finish();
  if (is_there(CaseSection::Kind::static_test)) tester.finish();
  return cases;
}

}  // namespace flexneck::pipeline
