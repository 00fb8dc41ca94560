// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <Eigen/Core>

#include "fe_modal/algebra/cholmod_order.h"
#include "fe_modal/algebra/petsc_handles.h"

namespace flexneck::fe_modal {

/// Of Inertia::growth: of a definite matrix it is 1, of K - sigma M with ten eigenvalues below
/// sigma 2. Rounding errors of 1e-16 that grew so much would still change eigenvalues by far less
/// than the gap of 5e-4 about sigma (solve/sturm_check.cpp).
inline constexpr double kMaxGrowth = 1e3;

/// Negative eigenvalues of a symmetric matrix by the pivots of a factor that is made as a Cholesky
/// factor is, without pivoting (Sylvester's law). Nothing where rounding errors grow in it: then
/// they may change the count.
/// @param matrix symmetric with the upper half stored by scalar rows
/// @param node_order of elimination, where it is given
/// @throws InputError if memory does not hold the factor.
std::optional<Eigen::Index> count_without_pivoting(Mat matrix, CholmodOrder kind,
                                                   std::span<const std::int32_t> node_order,
                                                   unsigned threads);

}  // namespace flexneck::fe_modal
