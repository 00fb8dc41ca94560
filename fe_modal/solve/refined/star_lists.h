// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fe_modal/dofs/dof_map.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// What the patches of a refined mesh are made of.
struct StarMesh {
  const mesher::Mesh& mesh;
  const DofMap& dof_map;
  /// (elements) what each was cut from; its elements follow one another.
  std::vector<std::int32_t> parents;
  /// (nodes) whose stars are wanted; empty: all.
  std::vector<bool> is_center;
};

/// The blocks of each patch.
using PatchLists = std::vector<std::vector<std::int32_t>>;

/// The blocks of each corner's star, ascending: of the nodes within all edges, faces and elements
/// that end there, the corner among them.
PatchLists find_stars(const StarMesh& body);

/// Whether elements of a kind have a node within.
bool has_inner_node(mesher::ElementKind kind);

/// Of the stars that lie within one parent whose elements have a node within, the largest of each.
/// In others there are too few nodes to make up for a divergence: solves there save no steps.
std::vector<std::size_t> find_cells(const StarMesh& body, const PatchLists& stars);

}  // namespace flexneck::fe_modal
