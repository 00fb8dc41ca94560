// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <Eigen/Core>

#include "fe_modal/algebra/block_product.h"
#include "fe_modal/algebra/cholmod_order.h"
#include "fe_modal/algebra/petsc_handles.h"

namespace flexneck::fe_modal {

/// A factor that was made as a Cholesky factor is, without pivoting: L S L^T = A + E, with E its
/// rounding errors.
struct SignedFactor {
  BlockOperator inverse;  ///< (L S L^T)^-1 x, of numbers neither very large nor very small
  Eigen::Index negative_pivots;
};

/// Vectors V that a count may treat apart, as those of modes near the value up to which is counted:
/// there A has eigenvalues near zero, and E may change their signs. Whatever V is, the count is
/// that of A; vectors that are no modes only keep it from being sure. This rank's rows.
struct KnownVectors {
  Eigen::MatrixXd vectors;        ///< V, (own dofs, m); m may be 0
  Eigen::MatrixXd mass_products;  ///< M V
};

/// Number of negative eigenvalues of A by the signs of a factor's pivots (Sylvester's law); nothing
/// where E may change it. With A_W and B_W that A and the factor B = A + E make of the vectors w
/// with V^T M w = 0 (Haynsworth, Linear Algebra Appl. 1 (1968) 73):
///
///     neg(B_W) = neg(B) - neg(V^T M B^-1 M V)
///     neg(A) = neg(A_W) + neg(V^T A V - Q),  Q = V^T A W A_W^-1 W^T A V, quadratic in residuals
///
/// Where I - B_W^-1 A_W contracts, every A_W + t E_W with t from 0 to 1 is regular, and neg(A_W) =
/// neg(B_W). Random columns show that: a direction that does not contract keeps its share of them.
/// Collective.
/// @param matrix A, for products in double precision
std::optional<Eigen::Index> count_by_factor(const Ranks& ranks, Mat matrix,
                                            const SignedFactor& factor, const KnownVectors& known);

/// The same by a factor in single precision, and where that does not tell by one in double.
/// @param matrix symmetric with the upper half stored by scalar rows
/// @param product the same, for products
/// @param node_order of elimination, where it is given
/// @throws InputError if memory does not hold the factor.
std::optional<Eigen::Index> count_without_pivoting(Mat matrix, Mat product, CholmodOrder kind,
                                                   std::span<const std::int32_t> node_order,
                                                   const KnownVectors& known, unsigned threads);

}  // namespace flexneck::fe_modal
