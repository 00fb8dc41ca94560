// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "fe_modal/dofs/dof_map.h"
#include "fe_modal/element/formulation.h"
#include "mesher/mesh/mesh.h"
#include "mesher/partition/element_partition.h"

namespace flexneck::fe_modal {

/// The elements of one rank, with node numbers of their own. Nodes between two ranks are in both
/// shares: the matrices of the shares add up to those of the body.
struct Share {
  mesher::Mesh mesh;                      ///< nodes, materials and blocks; no sets
  FormulationChoice formulation;          ///< of the materials
  std::vector<std::int32_t> nodes;        ///< (n) their numbers in the whole mesh, ascending
  std::vector<std::int32_t> free_index;   ///< (n) as DofMap::index, of the share's free nodes
  std::vector<std::int32_t> free_global;  ///< (free of the share) numbers in DofMap of the body,
                                          ///< ascending

  std::int32_t free_count() const { return static_cast<std::int32_t>(free_global.size()); }
};

/// One share for each process of the partition.
/// @pre the partition is one of this mesh
std::vector<Share> share_out(const mesher::Mesh& mesh, const DofMap& dof_map,
                             const mesher::ElementPartition& partition);

}  // namespace flexneck::fe_modal
