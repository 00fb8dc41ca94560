// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/dofs/dof_map.h"
#include "fe_modal/dofs/node_graph.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Lists of free nodes, ascending.
using NodeLists = std::vector<std::vector<std::int32_t>>;

/// The nodes of subdomains of some ten thousand nodes whatever the size of the body, at least two
/// where there are two elements. Elements belong to one each, nodes between them to several. None
/// goes across parts: the stiffness may jump by thousands there, and a coarse space follows a jump
/// only along the interface of subdomains.
NodeLists find_subdomains(const mesher::Mesh& mesh, const DofMap& dof_map);

/// An overlap extended by one layer of elements: of the nodes and their neighbours, those all of
/// whose neighbours are among these.
std::vector<std::int32_t> extended(const NodeGraph& graph, const std::vector<std::int32_t>& nodes);

/// m, (3, free nodes)
Eigen::Matrix3Xd free_positions(const mesher::Mesh& mesh, const DofMap& dof_map);

}  // namespace flexneck::fe_modal
