// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/dofs/node_graph.h"
#include "fe_modal/solve/iterative/subdomains.h"

namespace flexneck::fe_modal {

/// The interface of subdomains, cut into faces, edges and corners: nodes that the same subdomains
/// share and that hang together.
struct InterfacePieces {
  std::vector<std::int32_t> piece_of;  ///< of each node; -1 inside of a subdomain
  NodeLists nodes;                     ///< of each piece
};
InterfacePieces interface_pieces(const NodeGraph& graph, const NodeLists& subdomains);

/// Rigid motions of some nodes, orthonormal columns (3 nodes, r): six, five where the nodes are on
/// a line, three of one node.
Eigen::MatrixXd rigid_motions(const std::vector<std::int32_t>& nodes,
                              const Eigen::Matrix3Xd& positions_m);

}  // namespace flexneck::fe_modal
