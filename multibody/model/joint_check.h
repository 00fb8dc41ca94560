// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "multibody/model/model.h"
#include "multibody/numerics/error_estimate.h"

namespace flexneck::multibody {

/// How far a joint's markers miss what the joint holds of positions (m or m/s) and of orientations
/// (rad or rad/s).
struct Violation {
  double translation;
  double rotation;
};

/// Rounded input may miss by 1e-6 of the system's size and 1e-6 rad.
/// @param size_m  of the system
/// @throws InputError naming the joint and how far its markers are apart.
void check_positions(const Model& model, std::size_t joint, const Violation& found, double size_m);
/// Or by 1e-6 of the largest speed in the system, and by what rounding leaves of the rates of
/// motions at rest.
bool velocities_fit(const Violation& found, double size_m, double speed_m_s);
/// @throws InputError naming the joint and how fast its markers part if they do not fit.
void check_velocities(const Model& model, std::size_t joint, const Violation& found, double size_m,
                      double speed_m_s);

/// Whether the joints hold at the outputs of a run: a residual may not exceed what a step's error
/// may, "absolute + relative * reference" with the references of StateError. Where rows are left
/// out because others hold the same, those are held only as well as the model's numbers agree, to
/// 1e-5.
class JointGuard {
 public:
  /// @param model  must outlive this
  JointGuard(const Model& model, Tolerance tolerance, double size_m);

  /// Whether residuals, of which these are the squares, are below the absolute tolerance, whatever
  /// the references.
  bool is_nothing(const Violation& position, const Violation& velocity) const {
    const double square = tolerance_.absolute * tolerance_.absolute;
    return position.translation <= square && position.rotation <= square &&
           velocity.translation <= square && size_m_ * size_m_ * velocity.rotation <= square;
  }
  /// A joint's marker at the present output, before check().
  void see(const Eigen::Vector3d& position_m, const Eigen::Vector3d& velocity_m_s,
           const Eigen::Vector3d& angular_velocity_rad_s);
  /// @param left_out  rows of it, or of a joint that could make up for it
  /// @param cause     tells why a joint may not hold, if that is known; else empty
  /// @throws ComputationError naming the joint, by how much it misses and when.
  void check(double time_s, std::size_t joint, const Violation& position, const Violation& velocity,
             bool left_out, const std::function<std::string()>& cause = {}) const;

 private:
  const Model& model_;
  Tolerance tolerance_;
  double size_m_;
  double reach_m_ = 0;    ///< largest distance from the world's origin, and
  double speed_m_s_ = 0;  ///< largest speed so far: it may pass through zero
};

/// @throws InputError: a body that hangs on no prescribed one has no equilibrium.
[[noreturn]] void refuse_floating_body(const std::string& body);

}  // namespace flexneck::multibody
