// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/inertia_count.h"

#include <memory>

#include "fe_modal/algebra/blas_kernels.h"
#include "fe_modal/algebra/cholmod_handles.h"
#include "fe_modal/algebra/supernode_tree.h"
#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {

std::optional<Eigen::Index> count_without_pivoting(Mat matrix, CholmodOrder kind,
                                                   std::span<const std::int32_t> node_order,
                                                   unsigned threads) {
  const cholmod_sparse view = cholmod_view(matrix);
  CholmodAnalysis analysis(view, kind, node_order);
  const SupernodeTree tree(analysis.places(), analysis.block_size());
  require_memory("counting modes by inertia", 8.0 * static_cast<double>(tree.value_count()),
                 "take a coarser mesh, or leave out modes.certify");
  const auto values = std::make_unique_for_overwrite<double[]>(tree.value_count());
  try {
    const Inertia inertia = factorise_with_signs(
        tree, analysis.lower_half(), {values.get(), tree.value_count()}, threads_in_blas(threads));
    if (!(inertia.growth < kMaxGrowth)) return std::nullopt;
    return static_cast<Eigen::Index>(inertia.negative);
  } catch (const ComputationError&) {  // a pivot is zero
    return std::nullopt;
  }
}

}  // namespace flexneck::fe_modal
