// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "mesher/mesh/mesh.h"

/// Meshes of every kind, divided from structured 27-node hexahedra (block_mesh.h), whose nodes
/// include those of all other kinds.
namespace flexneck::testing {

/// Corners of the pieces of a hexahedron, by its own corners. Both divisions of the lower and the
/// upper facet run along 0-2 and 4-6, and on opposite facets all diagonals agree, so that
/// neighbours match.
std::vector<std::vector<std::size_t>> pieces_of_hexahedron(mesher::ReferenceShape shape);

/// The local node of the hex27 at each node of a `kind` whose corners are these.
std::vector<std::size_t> nodes_of_piece(mesher::ElementKind kind,
                                        const std::vector<std::size_t>& corners);

/// Chooses the kind that replaces the hexahedron with its centre at a point; none makes a hole.
using KindChoice = std::function<std::optional<mesher::ElementKind>(const Eigen::Vector3d&)>;

/// Replaces node numbers by others, everywhere but in the list of nodes itself.
void renumber(mesher::Mesh& mesh, const std::vector<std::int32_t>& new_number);

/// Removes the nodes that belong to no element.
void drop_loose_nodes(mesher::Mesh& mesh);

/// Facets of the elements whose nodes all lie in the region.
std::vector<mesher::FaceBlock> sides_within(const mesher::Mesh& mesh,
                                            const std::set<std::int32_t>& region);

/// Divides each hexahedron of a mesh of hex27 into elements of the kind chosen for it. Parts, node
/// sets and face sets keep their names.
mesher::Mesh with_kinds(const mesher::Mesh& hexahedra, const KindChoice& choose);

/// As with_kinds(), with one kind for all hexahedra.
mesher::Mesh with_kind(const mesher::Mesh& hexahedra, mesher::ElementKind kind);

/// Doubles the nodes for which `cut` is true, for the elements with their middle above z_m: a slit
/// between the two faces. Its normals point up; its areas are zero.
mesher::Mesh with_slit(const mesher::Mesh& whole, double z_m, bool tied,
                       const std::function<bool(const Eigen::Vector3d&)>& cut);

/// For each node, true if it lies on the boundary of the mesh, on a facet of one element only.
std::vector<bool> outside_nodes(const mesher::Mesh& mesh);

}  // namespace flexneck::testing
