// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/distributed/share.h"

#include <algorithm>
#include <utility>

#include "mesher/mesh/submesh.h"

namespace flexneck::fe_modal {
namespace {

/// Position in a list that ascends and has the value.
std::int32_t place_in(const std::vector<std::int32_t>& list, std::int32_t value) {
  return static_cast<std::int32_t>(std::lower_bound(list.begin(), list.end(), value) -
                                   list.begin());
}

Share share_of(const mesher::Mesh& mesh, const DofMap& dof_map,
               const mesher::ElementPartition& partition, std::int32_t process) {
  mesher::MeshPiece piece = mesher::submesh(mesh, partition.processes, process);
  Share share;
  share.mesh = std::move(piece.mesh);
  share.nodes = std::move(piece.nodes);
  for (const std::int32_t node : share.nodes) {
    if (dof_map.index(node) >= 0) share.free_global.push_back(dof_map.index(node));
  }
  // Nodes tied to one another share a number.
  std::sort(share.free_global.begin(), share.free_global.end());
  share.free_global.erase(std::unique(share.free_global.begin(), share.free_global.end()),
                          share.free_global.end());
  for (const std::int32_t node : share.nodes) {
    const std::int32_t index = dof_map.index(node);
    share.free_index.push_back(index < 0 ? -1 : place_in(share.free_global, index));
  }
  return share;
}

}  // namespace

std::vector<Share> share_out(const mesher::Mesh& mesh, const DofMap& dof_map,
                             const mesher::ElementPartition& partition) {
  std::vector<Share> shares;
  for (std::int32_t process = 0; process < partition.count; ++process) {
    shares.push_back(share_of(mesh, dof_map, partition, process));
  }
  return shares;
}

}  // namespace flexneck::fe_modal
