// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "multibody/descriptor/equations_of_motion.h"

namespace flexneck::multibody {

/// Brings a state back onto the joints, positions first, by the smallest change in the mass metric
/// (equations.md section 5).
class Projection {
 public:
  /// @param equations  must outlive this
  explicit Projection(EquationsOfMotion& equations);

  /// One Newton step for the positions, enough behind an integrator's step, then the velocities.
  /// Leaves `equations` updated for positions and velocities: solve() gives the accelerations.
  /// @param refactorise  if not, velocities and accelerations are solved for with the factors of
  ///     the state before: they then miss by the size of the correction, relative
  void apply(double time_s, Eigen::Ref<Eigen::VectorXd> state, bool refactorise = true);

  /// The same behind a step: the positions are corrected with the factors of the step's last stage,
  /// which lies within the step's error of its end, so that only one configuration is factorised.
  void apply_behind_step(double time_s, Eigen::Ref<Eigen::VectorXd> state);

  /// Newton steps for the positions only until the residual no longer falls, at most ten.
  /// Leaves `equations` updated for the positions. @return the largest residual left, m and rad.
  double converge_positions(double time_s, Eigen::Ref<Eigen::VectorXd> positions);

 private:
  using Segment = Eigen::Ref<Eigen::VectorXd>;

  void correct_positions(Segment& positions);
  /// One Newton step, behind which `equations_` are updated. Nothing without constraints.
  void step_positions(double time_s, Segment& positions);
  void correct_velocities(Segment& velocities);

  EquationsOfMotion& equations_;
  Eigen::VectorXd change_;
};

}  // namespace flexneck::multibody
