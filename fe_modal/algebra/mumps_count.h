// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include <Eigen/Core>

#include "fe_modal/algebra/dof_layout.h"
#include "fe_modal/algebra/symmetric_matrix.h"

namespace flexneck::fe_modal {

/// Negative eigenvalues of a symmetric matrix whose parts lie on the ranks, by MUMPS, which pivots:
/// for those of which count_without_pivoting() and count_on_ranks() are not sure. By its own
/// interface: PETSc's takes no order of elimination, and Debian's MUMPS has no METIS. Collective.
/// @param layout of the rows
/// @param part of the matrix, which adds to those of the other ranks
/// @param blocks (rows of the part / 3) their numbers in the whole matrix, ascending
/// @param order on the first rank: of elimination of all blocks
/// @throws InputError if memory does not hold the factor, ComputationError if MUMPS fails or an
/// eigenvalue is zero, on every rank.
Eigen::Index count_with_pivoting(const DofLayout& layout, SymmetricMatrix& part,
                                 std::span<const std::int32_t> blocks,
                                 std::span<const std::int32_t> order);

}  // namespace flexneck::fe_modal
