// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "multibody/equations/equations.h"
#include "multibody/numerics/small_lu.h"

namespace flexneck::multibody {

/// Equations of motion linearised about a state, for Newton's method over a step: with dQ = q dV'
/// and dV = v dV',
///   [mass + v damping + q stiffness, B^T; B, 0] [dV'; dlambda] = [-r; -Phi / q].
/// Damping and stiffness are differences of the residual, so that every force counts. Dense: meant
/// for models of up to about a hundred velocities. Nothing of its own
/// is allocated after construction.
class IterationMatrix {
 public:
  using Vector = Eigen::VectorXd;

  IterationMatrix(const Equations& equations, Eigen::Index state_size);

  /// About a state with its accelerations and multipliers.
  void linearise(Equations& equations, double time_s, const Vector& state,
                 const Vector& accelerations, const Vector& multipliers);
  /// For the factors q and v of a step.
  void factorise(double q, double v);
  /// Residual (velocities + constraints) -> correction of [V'; lambda].
  void solve(Vector& residual);
  /// change (velocities) <- S^-1 [mass change; 0]: what is left of it once the stiff modes resist.
  void filter(Vector& change);
  /// Whether the constraints that were redundant where it was linearised are so at another state:
  /// in a singular configuration, such as a parallelogram that lies flat, there are more of them.
  bool leaves_out_only_redundant(Equations& equations, double time_s, const Vector& state);

 private:
  Eigen::Index nq_, nv_, nc_;
  /// Constraints that others hold, ascending: their multiplier is zero.
  std::vector<Eigen::Index> redundant_, redundant_elsewhere_;
  Eigen::MatrixXd mass_, damping_, stiffness_, rows_transposed_;
  SmallLu factors_;
  Vector base_, moved_, state_, rate_, right_, change_;
  double q_ = 0;
};

}  // namespace flexneck::multibody
