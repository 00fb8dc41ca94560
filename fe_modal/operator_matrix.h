// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "fe_modal/block_product.h"
#include "fe_modal/petsc_handles.h"

namespace flexneck::fe_modal {

/// A symmetric linear map of N degrees of freedom as a matrix for PETSc and SLEPc, good for
/// products alone. All shells of this library are made here: block_product() finds the map behind
/// them and applies it to all columns at once.
class OperatorMatrix {
 public:
  OperatorMatrix(Eigen::Index size, BlockOperator apply);

  Mat get() const { return shell_.get(); }

 private:
  std::unique_ptr<const BlockOperator> apply_;  ///< at a fixed address: the shell points to it
  MatHandle shell_;
};

}  // namespace flexneck::fe_modal
