// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/exchange/fmu/fmu_model.h"

#include <array>

#include "geometry/foundation/content_hash.h"
#include "multibody/files/model_archive.h"
#include "multibody/history/recorder.h"

namespace flexneck::pipeline {

using multibody::DeformableBody;
using multibody::Model;
using multibody::RigidBody;
using multibody::SteppedRun;

template <class A>
void archive(A& all, ChannelSpec& x) {
  auto& [name, quantity, source, relative_to, axes, filter] = x;
  all(name, quantity, source, relative_to, axes, filter);
}
template <class A>
void archive(A& all, FormulaForce& x) {
  auto& [name, marker_i, marker_j, texts, breakpoints] = x;
  all(name, marker_i, marker_j, texts, breakpoints);
}
template <class A>
void archive(A& all, FmuModel& x) {
  auto& [model, solver, kind, end_time, interval, channels] = x;
  all(model, solver, kind, end_time, interval, channels);
  if (kind < SteppedRun::Kind::motion || kind > SteppedRun::Kind::quasi_static)
    ByteReader::refuse();
}

namespace {

/// Head of the archive; its version is raised when the content changes.
constexpr std::string_view kHead = "flexneck FMU model 3\n";

/// Calls visit(name, unit, what, member) for each parameter.
template <class Visit>
void each_parameter(Model& model, const Visit& visit) {
  constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
  for (Eigen::Index k = 0; k < 3; ++k)
    visit(std::string("solver.gravity.") + kAxes[static_cast<std::size_t>(k)], "m/s^2", "Gravity",
          model.gravity_m_s2[k]);
  for (multibody::Body& body : model.bodies) {
    const std::string of = "body." + body.name;
    if (auto* const rigid = std::get_if<RigidBody>(&body.kind))
      visit(of + ".mass", "kg", "Mass; the inertia about the centre of mass is unchanged",
            rigid->mass_kg);
    if (auto* const deformable = std::get_if<DeformableBody>(&body.kind))
      for (Eigen::Index k = 0; k < deformable->damping_ratio.size(); ++k)
        visit(of + ".damping_ratio." + deformable->modes.modes[static_cast<std::size_t>(k)].name,
              "1", "Damping ratio of the mode", deformable->damping_ratio[k]);
  }
  const auto resistance = [&](const std::string& of, multibody::Resistance& law, bool is_angle) {
    visit(of + ".damping", is_angle ? "N m s/rad" : "N s/m", "Viscous damping", law.damping);
    if (law.full_rate > 0)
      visit(of + ".friction", is_angle ? "N m" : "N", "Coulomb friction", law.friction);
  };
  for (auto& spring : model.forces.of<multibody::MarkerSpring>())
    resistance("spring." + spring.name, spring.resistance, false);
  for (auto& each : model.forces.of<multibody::JointResistance>())
    resistance("resistance." + each.name, each.resistance,
               each.coordinate != multibody::JointCoordinate::distance);
}

/// History with one output at the start, used for its layout only.
multibody::History layout_of(const Model& model) {
  multibody::OutputOptions one;
  one.begin_time_s = one.end_time_s = model.start.time_s;
  multibody::History history = multibody::Recorder(model, one).take();
  for (multibody::MarkerHistory& marker : history.markers) marker.rotation.col(0) << 1, 0, 0, 0;
  return history;
}

}  // namespace

std::string bytes_of(const FmuModel& fmu, std::vector<FormulaForce> formulas) {
  FmuModel rest = fmu;
  rest.model.forces.of<multibody::FunctionForce>().clear();
  ByteWriter writer;
  writer(rest, formulas);
  return std::string(kHead) + writer.bytes();
}

std::string token_of(const std::string& bytes) { return "{" + hash_of_text(bytes) + "}"; }

FmuModel fmu_model_of(std::string_view bytes) {
  if (!bytes.starts_with(kHead)) ByteReader::refuse();
  ByteReader reader(bytes.substr(kHead.size()));
  FmuModel fmu;
  std::vector<FormulaForce> formulas;
  reader(fmu, formulas);
  reader.finish();
  for (const FormulaForce& each : formulas) fmu.model.forces.add(function_force_of(each));
  return fmu;
}

std::vector<FmuVariable> variables_of(FmuModel& fmu) {
  std::vector<FmuVariable> variables = {{"time", Causality::independent, "s", "Time", 0}};
  each_parameter(fmu.model, [&](const std::string& name, const std::string& unit,
                                const std::string& what, double& value) {
    variables.push_back({name, Causality::parameter, unit, what, value});
  });
  for (const multibody::RunInput& input : multibody::inputs_of(fmu.model))
    variables.push_back({input.name, Causality::input, input.unit, input.what, 0});
  const multibody::History layout = layout_of(fmu.model);
  for (const ChannelSpec& spec : fmu.channels) {
    const multibody::Channel channel = channel_of(layout, spec, fmu.model.gravity_m_s2);
    for (const std::string& column : channel.columns)
      variables.push_back({channel.columns.size() == 1 ? channel.name : channel.name + "." + column,
                           Causality::output, channel.unit, "", 0});
  }
  return variables;
}

std::vector<double*> parameters_of(Model& model) {
  std::vector<double*> members;
  each_parameter(model, [&](const std::string&, const std::string&, const std::string&,
                            double& value) { members.push_back(&value); });
  return members;
}

}  // namespace flexneck::pipeline
