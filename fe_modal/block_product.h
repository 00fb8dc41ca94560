// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "fe_modal/petsc_handles.h"

namespace flexneck::fe_modal {

/// A vector of PETSc's on a column, which outlives it.
VecHandle column_vector(const Eigen::MatrixXd& columns, Eigen::Index column);

/// The matrix, or operator, times each column, (N, k).
Eigen::MatrixXd block_product(Mat matrix, const Eigen::MatrixXd& columns);

}  // namespace flexneck::fe_modal
