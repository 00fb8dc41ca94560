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

/// Whether A has as many negative eigenvalues as a factor that was made without pivoting, L S L^T =
/// A + E with E its rounding errors. Where I - (A + E)^-1 A = (A + E)^-1 E contracts, every A + t E
/// with t from 0 to 1 is regular, and no eigenvalue changes its sign between the two. Random
/// columns show that: a direction that does not contract keeps its share of them. Collective.
/// @param matrix A, for products in double precision
/// @param inverse (L S L^T)^-1 x, of numbers neither very large nor very small
bool has_inertia_of_factor(const Ranks& ranks, Mat matrix, const BlockOperator& inverse);

/// Negative eigenvalues of a symmetric matrix by the pivots of a factor that is made as a Cholesky
/// factor is, without pivoting (Sylvester's law): in single precision, where that does not tell in
/// double. Nothing where rounding errors may change the count.
/// @param matrix symmetric with the upper half stored by scalar rows
/// @param product the same, for products
/// @param node_order of elimination, where it is given
/// @throws InputError if memory does not hold the factor.
std::optional<Eigen::Index> count_without_pivoting(Mat matrix, Mat product, CholmodOrder kind,
                                                   std::span<const std::int32_t> node_order,
                                                   unsigned threads);

}  // namespace flexneck::fe_modal
