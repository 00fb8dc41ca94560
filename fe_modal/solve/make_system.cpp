// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/make_system.h"

#include <cstdint>
#include <vector>

#include "fe_modal/solve/distributed/distributed_system.h"
#include "fe_modal/solve/distributed/ranks.h"
#include "fe_modal/solve/iterative/iterative_system.h"
#include "fe_modal/solve/local_system.h"
#include "geometry/foundation/error.h"
#include "mesher/partition/element_partition.h"

namespace flexneck::fe_modal {
namespace {

/// The order of all nodes as one of the free ones; of tied nodes the first one counts.
std::vector<std::int32_t> order_of_free(const std::vector<std::int32_t>& node_order,
                                        const DofMap& dof_map) {
  std::vector<std::int32_t> order;
  std::vector<bool> has_come(static_cast<std::size_t>(dof_map.free_count()));
  for (const std::int32_t node : node_order) {
    const std::int32_t index = dof_map.index(node);
    if (index < 0 || has_come[static_cast<std::size_t>(index)]) continue;
    has_come[static_cast<std::size_t>(index)] = true;
    order.push_back(index);
  }
  // Rigid couplings last: they couple all of a face.
  for (std::size_t k = 0; !order.empty() && k < has_come.size(); ++k) {
    if (!has_come[k]) order.push_back(static_cast<std::int32_t>(k));
  }
  return order;
}

}  // namespace

std::unique_ptr<ModalSystem> make_system(const mesher::Mesh& mesh, const DofMap& dof_map,
                                         const ModalOptions& options) {
  std::vector<std::int32_t> order = order_of_free(options.node_order, dof_map);
  const bool alone = options.ranks == nullptr || options.ranks->count() == 1;
  if (dof_map.is_constrained() && (options.solver == Solver::iterative || !alone)) {
    throw InputError(
        "rigid interfaces and fixed directions are for the direct solver in one process: take "
        "averages and fix sets as a whole, or leave out --solver iterative and mpirun");
  }
  if (options.solver == Solver::iterative) {
    if (!alone) {
      throw InputError("the iterative solver works in one process: start it without mpirun");
    }
    return std::make_unique<IterativeSystem>(
        assemble(mesh, dof_map, options.formulation, options.prestress_m), mesh, dof_map);
  }
  if (alone) {
    return std::make_unique<LocalSystem>(
        assemble(mesh, dof_map, options.formulation, options.prestress_m), std::move(order));
  }
  const int count = options.ranks->count();
  const mesher::ElementPartition partition =
      options.element_ranks.empty() ? mesher::partition_elements(mesh, count)
                                    : mesher::ElementPartition{count, options.element_ranks};
  return std::make_unique<DistributedSystem>(*options.ranks, mesh, dof_map, options.formulation,
                                             partition, std::move(order));
}

}  // namespace flexneck::fe_modal
