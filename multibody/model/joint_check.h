// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "multibody/model/model.h"
#include "multibody/numerics/error_estimate.h"

namespace flexneck::multibody {

/// Residuals of a joint's constraints of positions (m or m/s) and of orientations (rad or rad/s).
struct Violation {
  double translation;
  double rotation;
};

/// Checks the positions of a joint. Rounded input may deviate by 1e-6 of the system's size and 1e-6
/// rad.
/// @param size_m  size of the system
/// @throws InputError naming the joint and the distance of its markers.
void check_positions(const Model& model, std::size_t joint, const Violation& found, double size_m);
/// Returns whether the residual is at most 1e-6 of the largest speed in the system plus the
/// rounding of rates at rest.
bool velocities_fit(const Violation& found, double size_m, double speed_m_s);
/// Checks the velocities of a joint.
/// @throws InputError naming the joint and the relative speed of its markers if they do not fit.
void check_velocities(const Model& model, std::size_t joint, const Violation& found, double size_m,
                      double speed_m_s);

/// Checks that the joints are satisfied at the outputs of a run: a residual may not exceed the
/// permitted error of a step, "absolute + relative * reference" with the references of StateError.
/// Rows that are left out as redundant are satisfied only as well as the model's numbers agree, to
/// 1e-5.
class JointGuard {
 public:
  /// @param model  must outlive this
  JointGuard(const Model& model, Tolerance tolerance, double size_m);

  /// Returns whether residuals, given by their squares, are below the absolute tolerance, whatever
  /// the references.
  bool is_nothing(const Violation& position, const Violation& velocity) const {
    const double square = tolerance_.absolute * tolerance_.absolute;
    return position.translation <= square && position.rotation <= square &&
           velocity.translation <= square && size_m_ * size_m_ * velocity.rotation <= square;
  }
  /// Records the motion of a joint's marker at the present output, before check().
  void see(const Eigen::Vector3d& position_m, const Eigen::Vector3d& velocity_m_s,
           const Eigen::Vector3d& angular_velocity_rad_s);
  /// Checks a joint.
  /// @param left_out  true if rows of it, or of a joint that could compensate for it, are left out
  /// @param cause     returns a reason for a violation, if one is known; else empty
  /// @throws ComputationError naming the joint, its residual and the time.
  void check(double time_s, std::size_t joint, const Violation& position, const Violation& velocity,
             bool left_out, const std::function<std::string()>& cause = {}) const;

 private:
  const Model& model_;
  Tolerance tolerance_;
  double size_m_;
  double reach_m_ = 0;    ///< largest distance from the world's origin, and
  double speed_m_s_ = 0;  ///< largest speed so far: it may pass through zero
};

/// @throws InputError: a body that is connected to no prescribed one has no equilibrium.
[[noreturn]] void refuse_floating_body(const std::string& body);

}  // namespace flexneck::multibody
