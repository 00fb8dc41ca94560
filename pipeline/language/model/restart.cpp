// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/model/restart.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/core.h>

#include "geometry/foundation/names.h"
#include "multibody/equations/force_set.h"
#include "pipeline/process/result_files.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::VectorXd;
using multibody::Body;
using multibody::BodyHistory;
using multibody::DeformableBody;
using multibody::History;
using multibody::PrescribedBody;

namespace {

/// Tolerance of times: outputs are at multiples of an interval, up to rounding.
constexpr double kSameTime = 1e-9;

Index output_at(const StudyTable& table, const History& history, double time_s) {
  if (history.time_s.size() == 0) table.refuse("file", "the history has no outputs");
  Index nearest = 0;
  (history.time_s.array() - time_s).abs().minCoeff(&nearest);
  const double found = history.time_s[nearest];
  if (std::abs(found - time_s) > kSameTime * std::max(1.0, std::abs(time_s)))
    table.refuse("time", fmt::format("the history has no output at {:.9g} s; the nearest is at "
                                     "{:.9g} s",
                                     time_s, found));
  return nearest;
}

void check_modes(const StudyTable& table, const Body& body, const History& history) {
  const auto& modes = std::get<DeformableBody>(body.kind).modes.modes;
  const auto found = std::find_if(history.modal.begin(), history.modal.end(),
                                  [&](const auto& modal) { return modal.body == body.name; });
  if (found == history.modal.end() || found->modes != names_of(modes))
    table.refuse("file", "the modes of body '" + body.name +
                             "' in the history differ from those of this model");
}

void take_state(const BodyHistory& state, Index at, Body& body) {
  const Eigen::Vector4d q = state.rotation.col(at);
  body.initial_pose = {state.position_m.col(at), Eigen::Quaterniond(q[0], q[1], q[2], q[3])};
  body.initial_velocity_m_s = state.velocity_m_s.col(at);
  body.initial_angular_velocity_rad_s = state.angular_velocity_rad_s.col(at);
  body.velocities_are_open = false;
  auto* const deformable = std::get_if<DeformableBody>(&body.kind);
  if (deformable == nullptr) return;
  deformable->initial_modal = state.modal.col(at);
  deformable->initial_modal_rate = state.modal_rate.col(at);
}

/// True if inertias differ by more than the rounding of numbers in a file.
bool differ(const VectorXd& there, const VectorXd& here) {
  if (there.size() == 0) return false;
  constexpr double kRounding = 1e-9;
  const VectorXd change = there - here;
  const double moments = here.segment<3>(4).sum();
  return std::abs(change[0]) > kRounding * here[0] ||
         change.segment<3>(1).norm() > kRounding * std::sqrt(here[0] * moments) ||
         change.tail<6>().norm() > kRounding * moments;
}

/// Restores the angles with the full turns counted up to the output.
void take_angles(const StudyTable& table, const multibody::StateHistory& state, Index at,
                 multibody::Model& model) {
  const auto angle = [&](const std::string& name) -> std::optional<double> {
    const auto found = std::ranges::find(state.angle_names, name);
    if (found == state.angle_names.end()) return std::nullopt;
    return state.angles(found - state.angle_names.begin(), at);
  };
  for (multibody::Joint& joint : model.joints) {
    if (!joint.kind->has_angle) continue;
    const std::optional<double> found = angle("joint " + joint.name);
    if (!found)
      table.refuse("file", "the history does not contain the number of revolutions of joint '" +
                               joint.name + "'; make it again with a joint of that name");
    joint.start_angle_rad = *found;
  }
  for (multibody::MeasuredAngle& each : model.angles)
    each.start_rad = angle("angle " + each.name).value_or(0);
}

}  // namespace

void read_restart(const StudyTable& table, multibody::Model& model,
                  std::vector<std::string>& warnings) {
  const std::filesystem::path path = table.file("file");
  const double time_s = table.quantity("time");
  table.finish();
  const History history = read_history(path).history;
  const std::vector<BodyHistory>& states = history.state.bodies;
  if (states.empty())
    table.refuse("file", path.string() +
                             ": the history has no states; make it again with states = true in "
                             "the [output] of its model");
  const Index at = output_at(table, history, time_s);
  std::size_t taken = 0;
  for (Body& body : model.bodies) {
    if (std::holds_alternative<PrescribedBody>(body.kind)) continue;
    const auto state = std::find_if(states.begin(), states.end(), [&](const BodyHistory& each) {
      return each.name == body.name;
    });
    if (state == states.end())
      table.refuse("file", "the history has no state of body '" + body.name + "'");
    const bool deforms = std::holds_alternative<DeformableBody>(body.kind);
    if (deforms) check_modes(table, body, history);
    if (!deforms && state->modal.rows() > 0)
      table.refuse("file",
                   "body '" + body.name + "' is deformable in the history and rigid in this model");
    take_state(*state, at, body);
    if (const VectorXd here = multibody::inertia_of(body); differ(state->inertia, here))
      warnings.push_back(
          fmt::format("restart: body '{}' has a different mass in this model ({:.6g} kg) than in "
                      "the history ({:.6g} kg); the run continues with the velocities of the "
                      "history, so that momentum and energy jump",
                      body.name, here[0], state->inertia[0]));
    ++taken;
  }
  if (taken != states.size())
    table.refuse(
        "file",
        fmt::format(
            "expected the states of the same bodies, but the history has {} and this model has {}",
            states.size(), taken));
  if (history.state.internal.rows() != multibody::internal_count(model.forces))
    table.refuse(
        "file",
        "the relaxation branches of the sections in the history differ from those of this model");
  take_angles(table, history.state, at, model);
  model.start = {history.time_s[at], history.state.internal.col(at),
                 history.energy.dissipated_J[at], history.energy.work_J[at]};
}

}  // namespace flexneck::pipeline
