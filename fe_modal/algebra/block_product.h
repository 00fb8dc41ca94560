// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <Eigen/Core>

#include "fe_modal/algebra/nodal_mass.h"
#include "fe_modal/algebra/petsc_handles.h"
#include "fe_modal/algebra/symmetric_matrix.h"

namespace flexneck::fe_modal {

/// A linear map of the free degrees of freedom, applied to each column: this rank's rows, (own
/// dofs, k).
using BlockOperator = std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>;

/// A vector of PETSc's on a column, which outlives it.
VecHandle column_vector(const Eigen::MatrixXd& columns, Eigen::Index column,
                        const Ranks& ranks = {});

/// The matrix, or operator, times each column, (N, k).
Eigen::MatrixXd block_product(Mat matrix, const Eigen::MatrixXd& columns);

/// The same of matrices whose entries are at hand, which are read once for eight columns: no cache
/// holds them.
Eigen::MatrixXd block_product(const SymmetricMatrix& matrix, const Eigen::MatrixXd& columns);
/// @param mass of the free nodes, for each of their three directions
Eigen::MatrixXd block_product(const NodalMass& mass, const Eigen::MatrixXd& columns);

}  // namespace flexneck::fe_modal
