// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/dofs/dof_map.h"
#include "fe_modal/dofs/node_graph.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Lists of blocks of degrees of freedom, ascending.
using NodeLists = std::vector<std::vector<std::int32_t>>;

/// Subdomains of a mesh. Elements belong to one each, blocks between them to several.
struct Subdomains {
  std::vector<std::int32_t> of_element;  ///< as for_each_element() counts them
  NodeLists blocks;                      ///< of each; together they are all
  std::vector<double> moduli_Pa;         ///< Young's, of the stiffest material of each
  std::vector<double> softest_Pa;        ///< Young's, of the softest element at each block, 0: none

  std::int32_t count() const { return static_cast<std::int32_t>(blocks.size()); }
};

/// Subdomains of some ten thousand nodes whatever the size of the body, at least two where there
/// are two elements. None goes across parts: the stiffness may jump by thousands there, and a
/// coarse space follows a jump only along the interface of subdomains.
/// @param least_count of subdomains, if there are as many elements
Subdomains find_subdomains(const mesher::Mesh& mesh, const DofMap& dof_map, int least_count = 1);

/// The rank that has each subdomain: they are taken in the order of their places along the longest
/// side of the body, about as many blocks for each rank, at least one subdomain if there are
/// enough.
std::vector<std::int32_t> ranks_of_subdomains(const mesher::Mesh& mesh,
                                              const Subdomains& subdomains, int rank_count);
/// The same of each element.
std::vector<std::int32_t> ranks_of_elements(const mesher::Mesh& mesh, const Subdomains& subdomains,
                                            int rank_count);

/// A subdomain that overlaps the others by a layer of elements: its blocks and of their neighbours
/// those all of whose neighbours are among these. Of much softer material it takes all neighbours,
/// into much stiffer one, which to a soft one is a support wherever it is held, it does not go.
/// @param graph of some blocks, which are all of these and their neighbours
/// @param blocks their numbers in the body, ascending
/// @return rows of the graph
std::vector<std::int32_t> extended(const Subdomains& subdomains, std::size_t number,
                                   const NodeGraph& graph, const std::vector<std::int32_t>& blocks);

}  // namespace flexneck::fe_modal
