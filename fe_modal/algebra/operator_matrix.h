// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>

#include <Eigen/Core>

#include "fe_modal/algebra/petsc_handles.h"

namespace flexneck::fe_modal {

/// Linear map of the free degrees of freedom, applied to each column: this rank's rows, (own dofs,
/// k).
using BlockOperator = std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>;

/// Symmetric linear map of the degrees of freedom as a matrix for PETSc and SLEPc, which supports
/// products alone; each rank gets and gives its own rows. All shells of this library are made here:
/// block_product() finds the map behind them and applies it to all columns at once.
class OperatorMatrix {
 public:
  struct Context;

  /// @param own_size number of rows of this rank
  OperatorMatrix(Eigen::Index own_size, BlockOperator apply, const Ranks& ranks = {});
  ~OperatorMatrix();
  OperatorMatrix(OperatorMatrix&& other) noexcept;
  OperatorMatrix& operator=(OperatorMatrix&& other) noexcept;

  Mat get() const { return shell_.get(); }

 private:
  std::unique_ptr<Context> context_;  ///< at a fixed address: the shell points to it
  MatHandle shell_;
};

/// The map behind a matrix that OperatorMatrix has made; null for other matrices.
const BlockOperator* operator_behind(Mat matrix);

/// Throws the exception of the map behind a matrix, if this was the cause of a failure of PETSc or
/// SLEPc with that matrix.
void rethrow_from(Mat matrix);

}  // namespace flexneck::fe_modal
