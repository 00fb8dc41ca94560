// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/dofs/dof_map.h"
#include "fe_modal/solve/iterative/subdomains.h"

namespace flexneck::fe_modal {

/// The interface of subdomains, cut into faces, edges and corners: blocks of degrees of freedom
/// that the same subdomains share and that hang together by elements. The same on all ranks.
struct InterfacePieces {
  std::vector<std::int32_t> piece_of;  ///< of each block; -1 inside of a subdomain
  NodeLists blocks;                    ///< of each piece
};
InterfacePieces interface_pieces(const mesher::Mesh& mesh, const DofMap& dof_map,
                                 const Subdomains& subdomains);

/// The body's six rigid motions, (dofs, 6): three translations and three rotations.
Eigen::MatrixXd rigid_motions(const mesher::Mesh& mesh, const DofMap& dof_map);

/// Rigid motions of some blocks, orthonormal columns (3 blocks, r): six of most, five of nodes on a
/// line, three of one node.
/// @param rigid those of the body
Eigen::MatrixXd rigid_motions_of(const std::vector<std::int32_t>& blocks,
                                 const Eigen::MatrixXd& rigid);

}  // namespace flexneck::fe_modal
