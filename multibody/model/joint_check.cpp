// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/model/joint_check.h"

#include <algorithm>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::multibody {
namespace {

constexpr double kTolerance = 1e-6;
/// Size of a system without extent, such as a point on a spherical joint.
constexpr double kSmallestSize_m = 1e-3;

/// Residual of rounding at any tolerance, as a fraction of the system's size or speed, at rest of
/// its size per second; kDigits is the fraction of the distance from the world's origin.
constexpr double kRounding = 1e-11;
constexpr double kDigits = 1e-13;
/// Accumulated residual, over a motion, of rows that are left out if the start just passes the
/// check.
constexpr double kLeftOut = 1e-5;

[[noreturn]] void refuse(const Joint& joint, const Model& model, const std::string& problem) {
  throw InputError("joint '" + joint.name + "' between markers '" +
                   model.markers[joint.marker_i].name + "' and '" +
                   model.markers[joint.marker_j].name + "': " + problem);
}

}  // namespace

void check_positions(const Model& model, std::size_t joint, const Violation& found, double size_m) {
  const double size = std::max(size_m, kSmallestSize_m);
  if (found.translation <= kTolerance * size && found.rotation <= kTolerance) return;
  refuse(model.joints[joint], model,
         "at the start the markers are " + rounded_text(found.translation) + " m and " +
             rounded_text(found.rotation) +
             " rad apart; give the bodies poses that are consistent with the joint");
}

bool velocities_fit(const Violation& found, double size_m, double speed_m_s) {
  const double size = std::max(size_m, kSmallestSize_m);
  const double allowed = kTolerance * speed_m_s + kRounding * size;
  return found.translation <= allowed && size * found.rotation <= allowed;
}

void check_velocities(const Model& model, std::size_t joint, const Violation& found, double size_m,
                      double speed_m_s) {
  if (velocities_fit(found, size_m, speed_m_s)) return;
  refuse(model.joints[joint], model,
         "at the start the markers separate with " + rounded_text(found.translation) + " m/s and " +
             rounded_text(found.rotation) +
             " rad/s; give the bodies velocities that are consistent with the joint");
}

JointGuard::JointGuard(const Model& model, Tolerance tolerance, double size_m)
    : model_(model),
      tolerance_{std::max(tolerance.relative, kRounding), tolerance.absolute},
      size_m_(size_m) {}

void JointGuard::see(const Eigen::Vector3d& position_m, const Eigen::Vector3d& velocity_m_s,
                     const Eigen::Vector3d& angular_velocity_rad_s) {
  reach_m_ = std::max(reach_m_, position_m.norm());
  speed_m_s_ = std::max({speed_m_s_, velocity_m_s.norm(), size_m_ * angular_velocity_rad_s.norm()});
}

void JointGuard::check(double time_s, std::size_t joint, const Violation& position,
                       const Violation& velocity, bool left_out,
                       const std::function<std::string()>& cause) const {
  const double relative = tolerance_.relative + (left_out ? kLeftOut : 0);
  const double length = tolerance_.absolute + relative * size_m_ + kDigits * reach_m_;
  const double angle = tolerance_.absolute + relative;
  const double speed = tolerance_.absolute + relative * speed_m_s_;
  // NaN exceeds every tolerance.
  if (position.translation <= length && position.rotation <= angle &&
      velocity.translation <= speed && size_m_ * velocity.rotation <= speed)
    return;
  const std::string known = cause ? cause() : "";
  throw ComputationError(
      "joint '" + model_.joints[joint].name + "' is violated at " + rounded_text(time_s) +
      " s: its markers are apart by " + rounded_text(position.translation) + " m and " +
      rounded_text(position.rotation) + " rad and separate with " +
      rounded_text(velocity.translation) + " m/s and " + rounded_text(velocity.rotation) +
      " rad/s, where the run's tolerances allow " + rounded_text(length) + " m, " +
      rounded_text(angle) + " rad and " + rounded_text(speed) +
      " m/s; further results would be wrong. " +
      (known.empty() ? "The joints may be nearly singular there; smaller tolerances may help"
                     : known));
}

void refuse_floating_body(const std::string& body) {
  throw InputError(
      "body '" + body +
      "': no joint or section connects it, directly or through others, to a prescribed body, "
      "so it has no equilibrium");
}

}  // namespace flexneck::multibody
