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

/// Meshes of every kind, cut from structured 27-node hexahedra (block_mesh.h), whose nodes are also
/// those of all other kinds.
namespace flexneck::testing {

/// Corners of the pieces of a hexahedron, by its own corners. Both cuts of the lower and the upper
/// side run along 0-2 and 4-6, and on opposite sides all diagonals agree, so that neighbours match.
std::vector<std::vector<std::size_t>> pieces_of_hexahedron(mesher::ReferenceShape shape);

/// The local node of the hex27 at each node of a `kind` whose corners are these.
std::vector<std::size_t> nodes_of_piece(mesher::ElementKind kind,
                                        const std::vector<std::size_t>& corners);

/// The kind that takes the place of the hexahedron with its centre there; none: a hole.
using KindChoice = std::function<std::optional<mesher::ElementKind>(const Eigen::Vector3d&)>;

/// Puts nodes in place of others, everywhere but in the list of nodes itself.
void renumber(mesher::Mesh& mesh, const std::vector<std::int32_t>& new_number);

/// Leaves out the nodes that belong to no element.
void drop_loose_nodes(mesher::Mesh& mesh);

/// Sides of the elements whose nodes all lie in the region.
std::vector<mesher::FaceBlock> sides_within(const mesher::Mesh& mesh,
                                            const std::set<std::int32_t>& region);

/// Cuts each hexahedron of a mesh of hex27 into elements of the kind chosen for it. Parts, node
/// sets and face sets keep their names.
mesher::Mesh with_kinds(const mesher::Mesh& hexahedra, const KindChoice& choose);

/// The same elements all of one kind.
mesher::Mesh with_kind(const mesher::Mesh& hexahedra, mesher::ElementKind kind);

/// Doubles the nodes that are `cut`, for the elements with their middle above z_m: a slit whose two
/// faces carry the pairs. Its normals point up; its areas are left zero.
mesher::Mesh with_slit(const mesher::Mesh& whole, double z_m, bool tied,
                       const std::function<bool(const Eigen::Vector3d&)>& cut);

/// For each node whether it lies on the outside of the mesh, on a side of one element only.
std::vector<bool> outside_nodes(const mesher::Mesh& mesh);

}  // namespace flexneck::testing
