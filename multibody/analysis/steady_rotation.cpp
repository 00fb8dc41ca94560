// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/analysis/steady_rotation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/QR>

#include "geometry/foundation/error.h"

namespace flexneck::multibody {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Fraction within which directions, axes and rates of rounded input count as the same.
constexpr double kSame = 1e-9;

constexpr int kMaxIterations = 100;
/// As in the search for an equilibrium at rest: extents of the longest step and of the one that
/// ends the search, and the fraction of the largest stiffness below which a direction is neutral.
constexpr double kLargestStep = 0.5;
constexpr double kConverged = 1e-10;
constexpr double kNeutral = 1e-10;
/// Extent by which unconstrained bodies may drift in one revolution.
constexpr double kDrift = 1e-6;

/// Extent of the displacements at which loads around the axis are compared, and the fraction of the
/// largest load by which they may differ: rounding is a tenth of it.
constexpr double kProbe = 2e-5;
constexpr double kEven = 1e-9;
/// Angle at which loads are compared: no multiple of it is a full turn, so that no pattern around
/// the axis repeats with it.
constexpr double kPhase_rad = 1;

bool is_along(const Vector3d& vector, const Vector3d& axis) {
  return vector.cross(axis.normalized()).norm() <= kSame * vector.norm();
}

bool is_constant(const TimeTable& table) {
  const std::vector<double>& times = table.times_s();
  if (times.empty()) return true;
  const double value = table.value(times.front());
  return table.value(times.front() - 1) == value && table.value(times.back() + 1) == value &&
         std::all_of(times.begin(), times.end(),
                     [&](double time) { return table.value(time) == value; });
}

[[noreturn]] void refuse(const std::string& what) {
  throw InputError(
      what +
      "; a linearisation about steady rotation needs constant coefficients in the rotating frame");
}

bool travels(const PrescribedBody& body) {
  return body.initial_velocity_m_s != 0 || !body.acceleration_m_s2.times_s().empty() ||
         !body.motion.is_none();
}

bool turns_unevenly(const PrescribedBody& body) {
  return !body.turn.acceleration_rad_s2.times_s().empty() || !body.turn.motion.is_none();
}

TurningFrame frame_of(const PrescribedBody& body) {
  return {body.turn.initial_rate_rad_s * body.turn.axis, body.turn.point_m};
}

bool is_same(const TurningFrame& a, const TurningFrame& b) {
  const Vector3d between = b.point_m - a.point_m;
  const double away = between.cross(a.rate_rad_s.normalized()).norm();
  return (a.rate_rad_s - b.rate_rad_s).norm() <= kSame * a.rate_rad_s.norm() &&
         away <= kSame * std::max(1.0, between.norm());
}

template <ForceElement Kind>
void check_load(const Kind& element, const Vector3d& axis) {
  if constexpr (TimedForce<Kind>)
    if (!is_constant(element.load_over_time())) refuse(title(element) + " varies with time");
  if constexpr (RelaxingForce<Kind>)
    if (element.branch_count() > 0) refuse(title(element) + " relaxes");
  if constexpr (WorldForce<Kind>)
    if (element.keeps_direction() && !is_along(element.direction, axis))
      refuse(title(element) + " is not parallel to the axis of rotation of the prescribed bodies");
}

void check_loads(const Model& model, const TurningFrame& frame) {
  const Vector3d& axis = frame.rate_rad_s;
  if (!is_along(model.gravity_m_s2, axis))
    refuse("gravity is not parallel to the axis of rotation of the prescribed bodies");
  for (const Joint& joint : model.joints)
    for (const JointMotor& motor : joint.motors)
      if (motor.path.moves()) refuse("motor '" + motor.name + "' moves its joint");
  model.forces.each_kind([&]<class Kind>(const std::vector<Kind>& elements) {
    for (const Kind& element : elements) check_load(element, axis);
  });
}

/// Checks that joints between rotating and non-rotating bodies permit the rotation.
void check_joints(const EquationsOfMotion& equations, const TurningFrame& frame) {
  const System& system = equations.system();
  const double rate = frame.rate_rad_s.norm();
  for (std::size_t k = 0; k < system.joints.size(); ++k) {
    const JointRows& joint = equations.joint(k);
    const Violation parting = violation(joint, joint.velocity_residual);
    double speed = rate * system.size_m;
    for (const std::size_t marker : {system.joints[k].marker_i, system.joints[k].marker_j})
      speed = std::max(speed, equations.marker(marker).pd.norm());
    if (parting.translation > kSame * speed || parting.rotation > kSame * rate)
      refuse("joint '" + system.joints[k].name +
             "' connects a body to one that does not rotate with it about the same axis");
  }
}

/// Checks that loads and their derivatives in the rotating frame do not depend on time.
void check_evenness(ReducedDynamics& here, const TurningFrame& frame) {
  const double rate = frame.rate_rad_s.norm();
  if (rate == 0) return;
  ReducedDynamics there = here.turned(kPhase_rad / rate);
  // Displacement xi and velocity rate xi; terms that are quadratic in both cancel.
  const auto change = [&](ReducedDynamics& seen, const VectorXd& xi) {
    return VectorXd(seen.accelerations_at(xi, rate * xi) - seen.accelerations_at(-xi, -rate * xi));
  };
  double largest = 0;
  double difference = 0;
  for (Eigen::Index i = 0; i < here.count(); ++i) {
    VectorXd xi = VectorXd::Unit(here.count(), i);
    xi *= kProbe / here.extent(xi);
    const VectorXd found = change(here, xi);
    largest = std::max(largest, found.lpNorm<Eigen::Infinity>());
    difference = std::max(difference, (change(there, xi) - found).lpNorm<Eigen::Infinity>());
  }
  const VectorXd none = VectorXd::Zero(here.count());
  const VectorXd load = there.accelerations_at(none) - here.accelerations_at(none);
  if (difference > kEven * largest || load.norm() > kEven / kProbe * largest)
    refuse(
        "a joint or a force element between rotating and non-rotating bodies is not rotationally "
        "symmetric about the axis");
}

/// Newton's step, and the accelerations that remain along neutral directions.
struct Step {
  VectorXd xi, rest;
};
Step newton_step(const MatrixXd& stiffness, const VectorXd& accelerations) {
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> factors;
  factors.setThreshold(kNeutral);
  factors.compute(stiffness);
  const VectorXd xi = factors.solve(accelerations);
  return {xi, accelerations - stiffness * xi};
}

}  // namespace

std::optional<TurningFrame> steady_rotation(const Model& model) {
  struct Prescribed {
    const std::string& name;
    const PrescribedBody& motion;
  };
  std::vector<Prescribed> turning, others;
  for (const Body& body : model.bodies) {
    const auto* prescribed = std::get_if<PrescribedBody>(&body.kind);
    if (prescribed == nullptr) continue;
    const PrescribedMotion start = PrescribedPath(body.initial_pose, *prescribed).at(0);
    (start.angular_velocity_rad_s.isZero(0) ? others : turning).push_back({body.name, *prescribed});
  }
  if (turning.empty()) return {};
  const TurningFrame frame = frame_of(turning.front().motion);
  for (const auto& [name, motion] : turning) {
    if (travels(motion) || turns_unevenly(motion))
      refuse("prescribed body '" + name +
             "' does not rotate at a constant rate about a fixed axis");
    if (!is_same(frame, frame_of(motion)))
      refuse("prescribed bodies '" + turning.front().name + "' and '" + name +
             "' rotate at different rates or about different axes");
  }
  for (const auto& [name, motion] : others)
    if (travels(motion) || turns_unevenly(motion))
      refuse("prescribed body '" + name + "' moves while others rotate");
  check_loads(model, frame);
  return frame;
}

VectorXd rotating_positions(EquationsOfMotion& equations, const TurningFrame& frame,
                            const VectorXd& positions) {
  VectorXd at = positions;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    ReducedDynamics reduced(equations, at, 0, frame);
    const VectorXd still = VectorXd::Zero(reduced.count());
    const VectorXd accelerations = reduced.accelerations_at(still);
    if (iteration == 0) check_joints(equations, frame);
    if (!accelerations.allFinite()) break;
    Step step = newton_step(reduced.stiffness(), accelerations);
    step.xi *= std::min(1.0, kLargestStep / std::max(reduced.extent(step.xi), kConverged));
    if (reduced.extent(step.xi) <= kConverged) {
      const double rate = std::max(frame.rate_rad_s.norm(), 1.0);
      if (reduced.extent(step.rest) * std::pow(2 * std::numbers::pi / rate, 2) > kDrift) break;
      check_evenness(reduced, frame);
      return reduced.positions_at(step.xi);
    }
    // Halve the step, to a thousandth of it at most, until it reduces the accelerations.
    for (int halving = 0; halving < 10; ++halving, step.xi /= 2)
      if (reduced.accelerations_at(step.xi).norm() < accelerations.norm()) break;
    at = reduced.positions_at(step.xi);
  }
  throw ComputationError(
      "no state of steady rotation, in which gravity, forces and centrifugal loads balance, was "
      "found from the given poses; near a critical speed there may be none");
}

}  // namespace flexneck::multibody
