// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/SparseCore>

#include "multibody/equations/equations.h"
#include "multibody/numerics/lu_factors.h"

namespace flexneck::multibody {

/// Equations of motion linearised about a state, for Newton's method over a step: with dQ = q dV'
/// and dV = v dV',
///   [mass + v damping + q stiffness, B^T; B, 0] [dV'; dlambda] = [-r; -Phi / q].
/// Damping and stiffness are differences of the residual, so that every force counts; bodies that
/// no equation sees together are moved at once. Sparse as the model is: work in proportion to the
/// number of bodies of a chain. Nothing of its own is allocated after construction where LuFactors
/// allocates nothing.
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
  /// change (velocities) <- S^-1 [mass change; motors' share of B change]: what is left of it once
  /// the stiff modes resist. Bodies whose motion motors and joints give keep their change.
  void filter(Vector& change);
  /// Whether the constraints that were redundant where it was linearised are so at another state:
  /// in a singular configuration, such as a parallelogram that lies flat, there are more of them.
  bool leaves_out_only_redundant(Equations& equations, double time_s, const Vector& state);

 private:
  using Matrix = Eigen::SparseMatrix<double>;
  using Places = std::vector<Eigen::Index>;

  void prepare_motion();
  void prepare_groups();
  void prepare_matrix();
  /// Moves the coordinate of this number of all blocks of a group: its columns of both differences.
  void differentiate(Equations& equations, double time_s, const Vector& state,
                     const Vector& accelerations, const Vector& multipliers,
                     const std::vector<std::size_t>& group, Eigen::Index coordinate);
  /// (moved - base) / step of the rows that velocity j touches.
  void take_column(Eigen::Index j, double step, Matrix& to) const;

  Eigen::Index nq_, nv_, nc_;
  std::vector<Equations::VelocityBlock> blocks_;
  std::vector<std::vector<std::size_t>> groups_;  ///< blocks that no equation sees together
  /// Constraints that others hold, ascending: their multiplier is zero.
  std::vector<Eigen::Index> redundant_, redundant_elsewhere_;
  std::vector<Eigen::Index> motors_;   ///< constraints
  std::vector<bool> given_;            ///< velocities that motors and joints give
  Matrix mass_, damping_, stiffness_;  ///< entries in the same places
  Matrix rows_transposed_;
  Matrix matrix_;
  /// Where in it the entries of mass_ are, those of rows_transposed_ and of its transpose, and its
  /// last diagonal.
  Places motion_places_, column_places_, row_places_, diagonal_places_;
  LuFactors factors_;
  Vector base_, moved_, state_, rate_, right_, change_;
  double q_ = 0;
};

}  // namespace flexneck::multibody
