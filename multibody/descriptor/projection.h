// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "multibody/descriptor/equations_of_motion.h"

namespace flexneck::multibody {

/// Makes a state satisfy the joints, positions first, by the smallest change in the mass metric
/// (equations.md section 5).
class Projection {
 public:
  /// @param equations  must outlive this
  explicit Projection(EquationsOfMotion& equations);

  /// Corrects the positions by one Newton step, which suffices after an integrator's step, then the
  /// velocities. Leaves `equations` updated for positions and velocities: solve() gives the
  /// accelerations.
  /// @param refactorise  if false, velocities and accelerations are solved with the factors of the
  /// uncorrected state: their relative error is then of the size of the correction
  void apply(double time_s, Eigen::Ref<Eigen::VectorXd> state, bool refactorise = true);

  /// As apply() after a step: the positions are corrected with the factors of the step's last
  /// stage, which lies within the step's error of its end, so that only one configuration is
  /// factorised.
  void apply_behind_step(double time_s, Eigen::Ref<Eigen::VectorXd> state);

  /// Corrects the positions alone by Newton steps until the residual no longer falls, at most ten.
  /// Leaves `equations` updated for the positions.
  /// @return the largest remaining residual, m and rad.
  double converge_positions(double time_s, Eigen::Ref<Eigen::VectorXd> positions);

 private:
  using Segment = Eigen::Ref<Eigen::VectorXd>;

  void correct_positions(Segment& positions);
  /// One Newton step, after which `equations_` are updated. Does nothing without constraints.
  void step_positions(double time_s, Segment& positions);
  void correct_velocities(Segment& velocities);

  EquationsOfMotion& equations_;
  Eigen::VectorXd change_;
};

}  // namespace flexneck::multibody
