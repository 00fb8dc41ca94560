// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// Cuts the mesh along face sets inside it, of elements of any kind. A node is doubled where the
/// elements around it are disconnected once the faces of the sets no longer connect them. So the
/// cut opens where it reaches a free surface (its mouth), and its inner edge (its tip) stays
/// connected.
///
/// Each set becomes a Slit of its name. Its lower side is the one with the first element of the
/// mesh; it keeps its nodes, the upper side gets the copies, which are appended slit by slit in the
/// order of the nodes they double. The set's faces become those of the lower side, normals towards
/// the upper one. A face of any other set follows the element that it belongs to; a node set gets
/// both nodes of a pair, unless the face set of its name has only one of them.
///
/// `Slit::areas_m2` is int N dA over the slit's faces, `normals` the mean of the faces' normals at
/// the node. The areas of a slit add up to that of its faces less the part that belongs to the tip.
/// With 8-node quadrilaterals the areas of corners are negative, with 6-node triangles zero, like
/// those of a consistent load.
///
/// @param tied marks the slits as closed: their pairs move as one node.
/// @throws InputError if there is no such set, one of its faces lies on the surface of the mesh or
/// in two slits, slits meet or cross, a cut has only one side, or no node is doubled. The mesh is
/// then unchanged.
void open_slits(Mesh& mesh, const std::vector<std::string>& face_sets, bool tied);

}  // namespace flexneck::mesher
