// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "mesher/mesh/submesh.h"

namespace flexneck::mesher {

/// Assigns whole parts to submeshes.
/// @param parts of each submesh
/// @throws InputError for an unknown part, and for one that belongs to no submesh or to two.
PieceOfElement pieces_by_parts(const Mesh& mesh,
                               const std::vector<std::vector<std::string>>& parts);

/// Assigns the elements between parallel planes to submeshes, from the lowest along the normal
/// upwards.
/// @param normal      unit vector
/// @param offsets_m   normal . x of each plane, increasing
/// @throws InputError for planes that do not increase, that leave a submesh without elements, or
/// that pass through an element.
PieceOfElement pieces_by_planes(const Mesh& mesh, const Eigen::Vector3d& normal,
                                std::span<const double> offsets_m);

/// Name of the face set that a submesh has in common with another.
std::string cut_name(const std::string& other_piece);

/// Divides a mesh into submeshes. A submesh has the faces and nodes of the whole's sets that belong
/// to it and, for each submesh that it touches, the common faces, their normals out of it, as a
/// face set and a node set of the name `cut_name(other)`. Slits stay with the submesh that they
/// cut.
/// @param names  of the submeshes
/// @throws InputError if a slit lies between two submeshes, and for a mesh with connections.
std::vector<MeshPiece> cut_apart(const Mesh& mesh, const PieceOfElement& piece_of_element,
                                 const std::vector<std::string>& names);

}  // namespace flexneck::mesher
