// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/SparseCore>

#include "multibody/descriptor/joints.h"
#include "multibody/numerics/weighted_elimination.h"

namespace flexneck::multibody {

/// Bodies and number of a joint's rows. kNoBody stands for a prescribed body.
struct JointPlace {
  static constexpr std::size_t kNoBody = static_cast<std::size_t>(-1);
  std::size_t body_i = kNoBody;
  std::size_t body_j = kNoBody;
  Eigen::Index rows = 0;
};

/// Solves [M B^T; B 0] [x; lambda] = [r; s] (equations.md section 5) for a mass matrix of one block
/// per body and rows of one or two blocks per joint. Bodies are eliminated first, then joints: with
/// M = L L^T the joints' matrix is S = Y^T Y, Y = L^-1 B^T, which is factorised within its envelope
/// in blocks of joint by joint, padded to full size. This is LDL^T without pivoting, safe because
/// the matrix is quasi-definite. A row that depends on those before it (independent_rows.h) is left
/// out: its multiplier is zero. These rows are determined once. The pivots of S show when a kept
/// row may have become dependent, and when masses differ so much that S has too few digits: then
/// WeightedElimination solves. Where the remainder of a row that is left out may be rounding, as in
/// long loops, the row itself is examined.
class KktSolver {
 public:
  /// @param lengths_m  (velocities) displacement of the body per unit of each velocity: scales the
  /// rows
  KktSolver(const std::vector<Eigen::Index>& body_sizes, const std::vector<JointPlace>& joints,
            Eigen::VectorXd lengths_m);

  Eigen::Index velocity_count() const { return velocity_count_; }
  Eigen::Index constraint_count() const { return constraint_count_; }
  Eigen::Index body_offset(std::size_t body) const { return bodies_[body].offset; }
  Eigen::Index joint_offset(std::size_t joint) const { return joints_[joint].offset; }

  void set_mass(std::size_t body, const Eigen::MatrixXd& mass);
  void set_rows(std::size_t joint, const JointRows& rows);
  /// Factorises, once all masses and rows are set.
  void factorise();
  /// @param r  (velocity_count), becomes x
  /// @param s  (constraint_count), becomes lambda
  void solve(Eigen::Ref<Eigen::VectorXd> r, Eigen::Ref<Eigen::VectorXd> s);

  /// A row of a joint that depends on those before it.
  struct RedundantRow {
    std::size_t joint;
    Eigen::Index row;
  };
  /// The rows that the last factorisation left out.
  std::vector<RedundantRow> redundant_rows() const;
  bool is_left_out(std::size_t joint, Eigen::Index row) const {
    return joints_[joint].left_out[static_cast<std::size_t>(row)];
  }
  /// B^T of the last factorisation with velocities in m/s, (velocity_count, constraint_count).
  Eigen::SparseMatrix<double> rows_in_metres() const;
  /// The body whose finite mass matrix was not positive definite in its last factorisation: results
  /// are NaN until all bodies are factorised again.
  std::optional<std::size_t> indefinite_body() const { return indefinite_body_; }
  /// Returns whether S of the last factorisation had enough digits.
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
    std::size_t blocks;  ///< index of that row's first block
    RowVector lambda;    ///< padded with zeros
    std::array<bool, kMaxRows> left_out;
  };
  /// Rows of two joints that act on the same body: a contribution to a block of S.
  struct Meeting {
    std::size_t row_joint, column_joint;
    bool row_is_i, column_is_i;
  };

  /// Changes of the rows that the pivots of S show.
  struct Pivots {
    bool lost = false;      ///< a kept row has too small a remainder
    bool appeared = false;  ///< a row that is left out may have become independent
  };

  void add_meetings(std::size_t row_joint);
  Block& block(std::size_t row_joint, std::size_t column_joint);
  void assemble_schur_complement();
  void factorise_bodies();
  Pivots factorise_schur_complement();
  static void factorise_diagonal(const JointBlock& joint, const RowVector& before, Block& diagonal,
                                 Pivots& pivots);
  /// @return true if other rows are left out than before.
  bool choose_rows();
  /// Returns whether the rows that are left out still depend on the others, by the factors of
  /// these.
  bool left_out_depend();
  /// Copies a row's Y^T into `to`, (velocity_count).
  void copy_row(const JointBlock& joint, Eigen::Index row, Eigen::VectorXd& to) const;
  /// Norm ||L z|| in metres.
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
  bool weighted_ = false;           ///< weighted_elimination_ has the factors
  std::vector<Eigen::Index> kept_;  ///< constraints in weighted_elimination_
  Eigen::VectorXd row_, no_rates_;  ///< workspace of left_out_depend()
};

}  // namespace flexneck::multibody
