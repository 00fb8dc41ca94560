// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

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

/// The product with the mass of the free nodes, for each of their three directions; the matrix is
/// read once for eight columns, since no cache holds it.
Eigen::MatrixXd block_product(const NodalMass& mass, const Eigen::MatrixXd& columns);

/// The product with a stiffness, read in the same way: y_i = sum_j K_ij (x_j - x_i) + S_i x_i, S_i
/// the sum of the blocks K_ij. Forces are what the nodes around a node move against it, and entries
/// of K x itself cancel: where it costs little energy, as bending of a slender body does, their
/// rounding would be a hundred times larger.
class SymmetricProduct {
 public:
  /// @param matrix must outlive this, with the entries that it has now
  explicit SymmetricProduct(const SymmetricMatrix& matrix);

  Eigen::MatrixXd operator()(const Eigen::MatrixXd& columns) const;

  const SymmetricMatrix& matrix() const { return *matrix_; }
  /// S_i of a node, (3, 3), row by row.
  const double* block_sum(std::size_t node) const { return block_sums_.data() + 9 * node; }

 private:
  const SymmetricMatrix* matrix_;
  std::vector<double> block_sums_;
};

}  // namespace flexneck::fe_modal
