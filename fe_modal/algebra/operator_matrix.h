// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>

#include <Eigen/Core>

#include "fe_modal/algebra/petsc_handles.h"

namespace flexneck::fe_modal {

/// A linear map of the free degrees of freedom, applied to each column: this rank's rows, (own
/// dofs, k).
using BlockOperator = std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>;

/// A symmetric linear map of the degrees of freedom as a matrix for PETSc and SLEPc, good for
/// products alone; on many ranks each gets and gives its own rows. All shells of this library are
/// made here: block_product() finds the map behind them and applies it to all columns at once.
class OperatorMatrix {
 public:
  struct Context;

  /// @param own_size rows of this rank
  OperatorMatrix(Eigen::Index own_size, BlockOperator apply, const Ranks& ranks = {});
  ~OperatorMatrix();
  OperatorMatrix(OperatorMatrix&& other) noexcept;
  OperatorMatrix& operator=(OperatorMatrix&& other) noexcept;

  Mat get() const { return shell_.get(); }

 private:
  std::unique_ptr<Context> context_;  ///< at a fixed address: the shell points to it
  MatHandle shell_;
};

/// What is behind a matrix that OperatorMatrix has made; null for others.
const BlockOperator* operator_behind(Mat matrix);

/// After PETSc or SLEPc failed with this matrix: throws what the map behind it has thrown, if that
/// was the cause.
void rethrow_from(Mat matrix);

}  // namespace flexneck::fe_modal
