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
/// Damping and stiffness are finite differences of the residual, so that every force counts; bodies
/// that occur in no common equation are moved at once. The matrix is as sparse as the model: work
/// proportional to the number of bodies of a chain. Allocates nothing after construction if
/// LuFactors allocates nothing.
class IterationMatrix {
 public:
  using Vector = Eigen::VectorXd;

  IterationMatrix(const Equations& equations, Eigen::Index state_size);

  /// Linearises about a state with its accelerations and multipliers.
  void linearise(Equations& equations, double time_s, const Vector& state,
                 const Vector& accelerations, const Vector& multipliers);
  /// Factorises for the factors q and v of a step.
  void factorise(double q, double v);
  /// Maps a residual (velocities + constraints) to the correction of [V'; lambda].
  void solve(Vector& residual);
  /// change (velocities) <- S^-1 [mass change; motors' part of B change]: the part that remains
  /// once the stiff modes resist. Bodies whose motion motors and joints determine keep their
  /// change.
  void filter(Vector& change);
  /// Returns whether the constraints that were redundant at the linearisation are so at another
  /// state: in a singular configuration, such as a flattened parallelogram, more of them are
  /// redundant.
  bool leaves_out_only_redundant(Equations& equations, double time_s, const Vector& state);

 private:
  using Matrix = Eigen::SparseMatrix<double>;
  using Places = std::vector<Eigen::Index>;

  void prepare_motion();
  void prepare_groups();
  void prepare_matrix();
  /// Moves the coordinate of this number of all blocks of a group and takes its columns of both
  /// differences.
  void differentiate(Equations& equations, double time_s, const Vector& state,
                     const Vector& accelerations, const Vector& multipliers,
                     const std::vector<std::size_t>& group, Eigen::Index coordinate);
  /// Sets (moved - base) / step in the rows that velocity j affects.
  void take_column(Eigen::Index j, double step, Matrix& to) const;

  Eigen::Index nq_, nv_, nc_;
  std::vector<Equations::VelocityBlock> blocks_;
  std::vector<std::vector<std::size_t>> groups_;  ///< groups of blocks that occur in no common
                                                  ///< equation
  /// Redundant constraints, ascending: their multiplier is zero.
  std::vector<Eigen::Index> redundant_, redundant_elsewhere_;
  std::vector<Eigen::Index> motors_;   ///< constraints of motors
  std::vector<bool> given_;            ///< velocities that motors and joints determine
  Matrix mass_, damping_, stiffness_;  ///< entries in the same places
  Matrix rows_transposed_;
  Matrix matrix_;
  /// Positions in matrix_ of the entries of mass_, of rows_transposed_ and of its transpose, and of
  /// its last diagonal.
  Places motion_places_, column_places_, row_places_, diagonal_places_;
  LuFactors factors_;
  Vector base_, moved_, state_, rate_, right_, change_;
  double q_ = 0;
};

}  // namespace flexneck::multibody
