// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "mesher/mesh/submesh.h"

namespace flexneck::mesher {

/// Pieces made of whole parts. @param parts of each piece
/// @throws InputError for an unknown part, and for one that belongs to no piece or to two.
PieceOfElement pieces_by_parts(const Mesh& mesh,
                               const std::vector<std::vector<std::string>>& parts);

/// Pieces between parallel planes, from the lowest along the normal upwards.
/// @param normal      unit vector
/// @param offsets_m   normal . x of each plane, increasing
/// @throws InputError for planes that do not increase, that leave a piece without elements, or that
/// pass through an element.
PieceOfElement pieces_by_planes(const Mesh& mesh, const Eigen::Vector3d& normal,
                                std::span<const double> offsets_m);

/// Name of the face set of a piece that it has in common with another.
std::string cut_name(const std::string& other_piece);

/// Cuts a mesh apart. A piece has the faces and nodes of the whole's sets that belong to it, and
/// for each piece that it touches the common faces, their normals out of it, as a face set and a
/// node set of the name `cut_name(other)`. Slits stay with the piece that they cut.
/// @param names  of the pieces
/// @throws InputError if a slit lies between two pieces, and for a mesh with connections.
std::vector<MeshPiece> cut_apart(const Mesh& mesh, const PieceOfElement& piece_of_element,
                                 const std::vector<std::string>& names);

}  // namespace flexneck::mesher
