// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "fe_modal/algebra/inertia_count.h"
#include "fe_modal/algebra/separator.h"
#include "fe_modal/algebra/shift_inverse.h"
#include "fe_modal/algebra/symmetric_matrix.h"
#include "fe_modal/dofs/node_graph.h"
#include "fe_modal/solve/iterative/single_inverse.h"
#include "fe_modal/system/rank_part.h"

namespace flexneck::fe_modal {

/// A matrix to which each rank has its summand, on the blocks of its part.
struct DistributedMatrix {
  const DofLayout& layout;
  std::span<const std::int32_t> blocks;  ///< of this rank's part, their numbers in the whole
  const NodeGraph& graph;                ///< of these
  const SymmetricMatrix& summand;
  /// Whether the blocks have the order in which their part eliminates them: then the summand is
  /// taken as it is, without a copy.
  bool is_in_order = false;
};

/// In which order a part eliminates its blocks: those inside, by nested dissection, then those of
/// the separator.
std::vector<std::int32_t> order_of_part(const NodeGraph& graph, const Separator& separator);

/// (K - shift M)^-1 by a factor on all ranks, in single precision or, where pivots are doubtful, in
/// double: each eliminates the blocks that it alone has, as a process alone does
/// (SupernodalFactor), and all of them what is between their parts. Collective.
/// @param matrix K - shift M; not needed afterwards
/// @throws InputError if memory does not hold the factor, ComputationError if the matrix is not
/// positive definite or memory runs out.
std::unique_ptr<ShiftInverse> make_shift_inverse(const DistributedMatrix& matrix,
                                                 const Matrices& matrices, double shift,
                                                 SingleInverse::InDouble make_in_double);
/// The same in double.
std::unique_ptr<ShiftInverse> make_distributed_in_double(const DistributedMatrix& matrix,
                                                         double shift);

/// Collective: negative eigenvalues of a matrix, by the same elimination with pivots of either
/// sign. Those of the parts and of the Schur complement between them add up (Haynsworth, Linear
/// Algebra Appl. 1 (1968) 73). As count_without_pivoting().
/// @param product the matrix, for products
std::optional<Eigen::Index> count_on_ranks(const DistributedMatrix& matrix, Mat product,
                                           const KnownVectors& known);

}  // namespace flexneck::fe_modal
