// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/algebra/pivots.h"
#include "fe_modal/algebra/supernodal_elimination.h"
#include "fe_modal/algebra/supernode_tree.h"

namespace flexneck::fe_modal {

class CholmodAnalysis;

/// Supernodal Cholesky factor, P A P^T = L L^T, of numbers of double or single precision: half the
/// memory, and half the time of a solve, which is spent on reading the factor. Rows that are kept
/// are not eliminated: L has the other columns, and their Schur complement is left. With pivots of
/// any sign it is L S L^T, S of +1 and -1 on the diagonal.
template <typename Scalar>
class SupernodalFactor {
 public:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  SupernodalFactor() = default;
  /// @param kept columns of each block of the last rows that are kept
  /// @throws ComputationError if the matrix is not positive definite or, with pivots of any sign,
  /// one of them is zero, or memory runs out.
  SupernodalFactor(CholmodAnalysis& analysis, unsigned threads, std::span<const int> kept = {},
                   Pivots pivots = Pivots::positive);
  /// The same in another precision.
  template <typename Other>
  explicit SupernodalFactor(SupernodalFactor<Other>&& other);

  /// Entry k is the row of A that comes k-th.
  std::span<const int> order() const { return tree_.order(); }
  /// Numbers that are kept.
  std::size_t value_count() const { return tree_.value_count(); }
  /// Of the matrix's entries on the diagonal the smallest share that elimination left for a pivot:
  /// where it comes near the rounding of the numbers, some digits or all of a solution are lost.
  double smallest_pivot() const { return smallest_pivot_; }
  Eigen::Index negative_pivots() const;
  /// x = (L S L^T)^-1 x, the same to the last bit by any number of threads.
  /// @param x (n, k), rows in the order of elimination
  void solve(Matrix& x, unsigned threads) const;
  /// The same with rows in the order of A.
  Eigen::MatrixXd solution(const Eigen::MatrixXd& right_hand_sides, unsigned threads) const;
  /// The two halves of solve(): x = L^-1 x, with -L_k L^-1 x added to the rows that are kept, and
  /// with these as they are x = L^-T (S x - L_k^T x_k).
  void eliminate(Matrix& x, unsigned threads) const;
  void substitute(Matrix& x, unsigned threads) const;

  /// Of the rows that are kept; afterwards it is gone.
  SchurComplement<Scalar> take_complement() { return std::move(complement_); }

 private:
  template <typename Other>
  friend class SupernodalFactor;
  template <std::size_t lanes>
  class Solve;

  /// Calls work(some columns) for all columns of x, on which it leaves what work makes of them: of
  /// eight or, in single precision, sixteen columns together.
  template <typename Work>
  void by_lanes(Matrix& x, const Work& work) const;
  template <std::size_t lanes, typename Work>
  void by_lanes(Matrix& x, const Work& work) const;
  void number_ancestor_rows();
  void find_smallest_pivot(const LowerHalf& matrix);

  SupernodeTree tree_;
  /// As the tree's row lists, but in those of a subtree row end_row + k stands for its ancestor k.
  std::vector<int> rows_;
  std::unique_ptr<Scalar[]> values_;
  std::vector<Scalar> signs_;  ///< S; empty where all pivots are positive
  SchurComplement<Scalar> complement_;
  double smallest_pivot_ = 1;
};

}  // namespace flexneck::fe_modal
