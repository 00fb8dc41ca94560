// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "multibody/history/incomplete_run.h"
#include "multibody/history/recorder.h"
#include "multibody/model/prescribed_path.h"
#include "multibody/time/motion.h"
#include "multibody/time/snap_search.h"

namespace flexneck::multibody {
namespace {

/// The largest angle by which a prescribed body or a motor rotates from one time to another.
double prescribed_turn_rad(const Model& model, double begin_s, double end_s) {
  double largest = 0;
  for (const Body& body : model.bodies)
    if (const auto* prescribed = std::get_if<PrescribedBody>(&body.kind)) {
      const PrescribedPath path(body.initial_pose, *prescribed);
      largest = std::max(largest, std::abs(path.angle_rad(end_s) - path.angle_rad(begin_s)));
    }
  for (const Joint& joint : model.joints)
    for (const JointMotor& motor : joint.motors)
      if (motor.coordinate == JointCoordinate::angle)
        largest = std::max(largest, std::abs(motor.path.value(end_s) - motor.path.value(begin_s)));
  return largest;
}

}  // namespace

void settle_until(const Model& model, Equations& equations, RunWatch& watch, double begin_s,
                  double end_s, Eigen::VectorXd& state) {
  constexpr double kApart_rad = 1;
  const int parts = 1 + static_cast<int>(prescribed_turn_rad(model, begin_s, end_s) / kApart_rad);
  for (int k = 1; k <= parts; ++k) {
    const double time_s = k < parts ? begin_s + (end_s - begin_s) * k / parts : end_s;
    equations.settle(time_s, state, watch);
  }
}

History settle_along(const Model& model, Equations& equations,
                     const std::function<void()>& checkpoint, const OutputOptions& output) {
  check_motions_reach(model, output.end_time_s);
  Recorder recorder(model, output);
  SnapSearch jumps(model, equations);
  const auto with_warnings = [&](History history) {
    for (const std::string& each : jumps.warnings()) history.warnings.push_back(each);
    return history;
  };
  const auto count = [&] { recorder.statistics().evaluations = equations.evaluations(); };
  Eigen::Index column = 0;
  try {
    Eigen::VectorXd state = equations.given_place();
    for (; column < recorder.columns(); ++column) {
      const double time_s = recorder.time_s(column);
      const double begin_s = recorder.time_s(std::max<Eigen::Index>(column - 1, 0));
      const Eigen::VectorXd before = state;
      settle_until(model, equations, recorder.watch(), begin_s, time_s, state);
      if (column > 0) jumps.look(recorder.watch(), begin_s, before, time_s, state);
      Eigen::VectorXd recorded = state;
      recorder.begin(column);
      equations.record(time_s, recorded, recorder, column);
      recorder.look(column);
      recorder.conserve_energy(column);
      if (column == 0)
        recorder.mobility(equations.freedoms(), equations.redundant_constraints(),
                          equations.doubts());
      if (checkpoint) checkpoint();
    }
  } catch (const ComputationError& error) {
    count();
    const std::string why =
        std::string(error.what()) + ", at " + rounded_text(recorder.time_s(column)) + " s";
    throw IncompleteRun(why, with_warnings(recorder.take_incomplete(column, why)));
  }
  count();
  return with_warnings(recorder.take());
}

}  // namespace flexneck::multibody
