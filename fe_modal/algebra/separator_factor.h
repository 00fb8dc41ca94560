// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/algebra/blas.h"
#include "fe_modal/algebra/pivots.h"
#include "fe_modal/algebra/ranks.h"
#include "fe_modal/algebra/separator.h"

namespace flexneck::fe_modal {

/// Adds factor times values of some of a panel's rows, in all of its columns, to the panel.
/// @param rows (values.rows) of the separator, ascending
template <typename Scalar>
void add_rows(Scalar factor, const DenseBlock<const Scalar>& values, std::span<const int> rows,
              const Panel& panel, const DenseBlock<Scalar>& sum);

/// L S L^T of the Schur complement of a separator, to which each rank has its summand. Each panel
/// is kept by one rank: it factorises it and sends it to all, which update those that they keep.
/// Every member is collective and gives the same on all ranks. Of double and float.
template <typename Scalar>
class SeparatorFactor {
 public:
  /// Adds this rank's summand to the lower half of a panel, (rows, columns), and may let it go.
  using AddSummand = std::function<void(std::size_t panel, const DenseBlock<Scalar>& sum)>;

  /// @param panels must outlive this
  /// @param diagonal (rows of the separator) of the matrix before anything was eliminated
  /// @throws ComputationError if a pivot is not positive or, of any sign, zero; std::bad_alloc as
  /// one on all ranks.
  SeparatorFactor(const Ranks& ranks, const std::vector<Panel>& panels, Pivots pivots,
                  const Eigen::VectorXd& diagonal, const AddSummand& add);

  /// x = (L S L^T)^-1 x of all columns, (rows of the separator, k), which all ranks have whole.
  void solve(Eigen::MatrixXd& x) const;

  double smallest_pivot() const { return smallest_pivot_; }  ///< as SupernodalFactor's
  Eigen::Index negative_pivots() const;
  double entry_count() const;  ///< of all panels

 private:
  class Elimination;
  class Solve;

  Ranks ranks_;
  const std::vector<Panel>& panels_;
  std::vector<std::vector<Scalar>> values_;  ///< (panels), empty where another rank keeps one
  std::vector<Scalar> signs_;                ///< (rows)
  double smallest_pivot_ = 1;
};

}  // namespace flexneck::fe_modal
