// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "fe_modal/algebra/supernode_tree.h"

namespace flexneck::fe_modal {

/// The lower half of P A P^T by columns, rows ascending.
struct LowerHalf {
  std::span<const int> offsets;  ///< (N + 1)
  std::span<const int> rows;
  std::span<const double> values;
};

/// The lower half of A_kk - L_k L_k^T of the rows that a tree keeps: the values of each of its
/// blocks. Nothing where none is kept.
template <typename Scalar>
using SchurComplement = std::vector<std::vector<Scalar>>;

/// Finds the entries of L by left-looking supernodal elimination (Ng and Peyton, SIAM J. Sci.
/// Comput. 14 (1993) 1034): each block takes the updates of its descendants and is factorised by
/// the BLAS. CHOLMOD does the same in double precision and one thread. Here threads take subtrees,
/// then strips of rows of each supernode of the top; these do not depend on the number of threads,
/// so that the factor is the same to the last bit by any.
/// @param values tree.value_count() numbers, in any state
/// @param threads that may call the BLAS at once
/// @throws ComputationError if the matrix is not positive definite.
template <typename Scalar>
SchurComplement<Scalar> factorise(const SupernodeTree& tree, const LowerHalf& matrix,
                                  std::span<Scalar> values, unsigned threads);

/// P A P^T = L S L^T with S of +1 and -1 on the diagonal, found as factorise() finds L, without
/// pivoting: rounding errors may grow in it.
/// @param signs (rows) takes S, +1 of the rows that are kept
/// @throws ComputationError on a pivot that is zero.
template <typename Scalar>
SchurComplement<Scalar> factorise_with_signs(const SupernodeTree& tree, const LowerHalf& matrix,
                                             std::span<Scalar> values, std::vector<Scalar>& signs,
                                             unsigned threads);

}  // namespace flexneck::fe_modal
