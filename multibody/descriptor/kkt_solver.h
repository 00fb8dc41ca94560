// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/SparseCore>

#include "multibody/descriptor/joints.h"
#include "multibody/numerics/weighted_elimination.h"

namespace flexneck::multibody {

/// Where a joint's rows act. kNoBody stands for a prescribed body.
struct JointPlace {
  static constexpr std::size_t kNoBody = static_cast<std::size_t>(-1);
  std::size_t body_i = kNoBody;
  std::size_t body_j = kNoBody;
  Eigen::Index rows = 0;
};

/// Solves [M B^T; B 0] [x; lambda] = [r; s] (equations.md section 5) for a mass matrix of one block
/// a body and rows of one or two blocks a joint. Elimination in the order bodies, then joints: with
/// M = L L^T the joints are left with S = Y^T Y, Y = L^-1 B^T, which is factorised inside its
/// envelope in blocks of a joint by a joint, padded to full size. This is LDL^T without pivoting,
/// safe because the matrix is quasi-definite. A row that depends on those before it
/// (independent_rows.h) is left out: its multiplier is zero. Which these are is found once. Pivots
/// of S tell when a kept row may have come to depend, and when masses differ so much that S has too
/// few digits left: then WeightedElimination solves. Where rounding may be what is left of a row
/// that is left out, as in long loops, the row itself is looked at.
class KktSolver {
 public:
  /// @param lengths_m  (velocities) by which a unit of each moves its body: measures rows
  KktSolver(const std::vector<Eigen::Index>& body_sizes, const std::vector<JointPlace>& joints,
            Eigen::VectorXd lengths_m);

  Eigen::Index velocity_count() const { return velocity_count_; }
  Eigen::Index constraint_count() const { return constraint_count_; }
  Eigen::Index body_offset(std::size_t body) const { return bodies_[body].offset; }
  Eigen::Index joint_offset(std::size_t joint) const { return joints_[joint].offset; }

  void set_mass(std::size_t body, const Eigen::MatrixXd& mass);
  void set_rows(std::size_t joint, const JointRows& rows);
  /// Once all masses and rows are set.
  void factorise();
  /// @param r  (velocity_count), becomes x
  /// @param s  (constraint_count), becomes lambda
  void solve(Eigen::Ref<Eigen::VectorXd> r, Eigen::Ref<Eigen::VectorXd> s);

  /// A row of a joint that those before it hold already.
  struct RedundantRow {
    std::size_t joint;
    Eigen::Index row;
  };
  /// Those that the last factorisation left out.
  std::vector<RedundantRow> redundant_rows() const;
  bool is_left_out(std::size_t joint, Eigen::Index row) const {
    return joints_[joint].left_out[static_cast<std::size_t>(row)];
  }
  /// B^T of the last factorisation with velocities in m/s, (velocity_count, constraint_count).
  Eigen::SparseMatrix<double> rows_in_metres() const;
  /// The body whose mass matrix, itself all numbers, was not positive definite when it was
  /// factorised last: what followed is not a number, up to a factorisation of all bodies.
  std::optional<std::size_t> indefinite_body() const { return indefinite_body_; }
  /// Tells whether S of the last factorisation had enough digits.
  bool is_well_scaled() const { return !weighted_; }

 private:
  using Block = Eigen::Matrix<double, kMaxRows, kMaxRows>;

  struct BodyBlock {
    Eigen::Index offset;
    Eigen::MatrixXd factor;
  };
  struct JointBlock {
    JointPlace place;
    Eigen::Index offset;
    TransposedRows Y_i, Y_j;
    std::size_t first;   ///< first joint in this one's row of S's envelope
    std::size_t blocks;  ///< where that row's blocks start
    RowVector lambda;    ///< padded with zeros
    std::array<bool, kMaxRows> left_out;
  };
  /// Two joints' rows that meet on a body: a contribution to a block of S.
  struct Meeting {
    std::size_t row_joint, column_joint;
    bool row_is_i, column_is_i;
  };

  /// What the pivots of S say about the rows.
  struct Pivots {
    bool lost = false;      ///< of a row that is kept too small a share is left
    bool appeared = false;  ///< one that is left out may have become independent
  };

  void add_meetings(std::size_t row_joint);
  Block& block(std::size_t row_joint, std::size_t column_joint);
  void assemble_schur_complement();
  void factorise_bodies();
  Pivots factorise_schur_complement();
  static void factorise_diagonal(const JointBlock& joint, const RowVector& before, Block& diagonal,
                                 Pivots& pivots);
  /// @return whether other rows are left out than before.
  bool choose_rows();
  /// Tells whether those that are left out still depend on the others, as the factors of these
  /// tell.
  bool left_out_depend();
  /// Y^T of a row into `to`, (velocity_count).
  void copy_row(const JointBlock& joint, Eigen::Index row, Eigen::VectorXd& to) const;
  /// ||L z|| in metres.
  double length_m(const Eigen::VectorXd& z) const;
  void factorise_weighted();
  void solve_weighted(Eigen::Ref<Eigen::VectorXd> z, Eigen::Ref<Eigen::VectorXd> s);
  void solve_by_schur_complement(Eigen::Ref<Eigen::VectorXd> z, Eigen::Ref<Eigen::VectorXd> s);
  void solve_schur_complement();

  std::vector<BodyBlock> bodies_;
  std::vector<JointBlock> joints_;
  std::vector<Meeting> meetings_;
  Eigen::Index velocity_count_ = 0;
  Eigen::Index constraint_count_ = 0;
  std::optional<std::size_t> indefinite_body_;
  std::vector<Block> schur_;  ///< row by row of the lower triangle; its factor after factorise()
  Eigen::VectorXd lengths_m_;
  WeightedElimination weighted_elimination_;
  bool weighted_ = false;           ///< it has the factors
  std::vector<Eigen::Index> kept_;  ///< its constraints
  Eigen::VectorXd row_, no_rates_;  ///< room for left_out_depend()
};

}  // namespace flexneck::multibody
