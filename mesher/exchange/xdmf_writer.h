// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "mesher/mesh/mesh_file.h"

namespace flexneck::mesher {

/// Writes "mesh.xdmf" beside a mesh file "mesh.h5" for ParaView: a grid for each part, with its
/// material, quality (scaled Jacobian) and, where the file has partitions, the process of each
/// element; a grid for each face set and node set. Positions and sets are read from the mesh file
/// itself. ParaView wants the nodes of an element in another order, which XDMF cannot permute: the
/// reordered connectivity is in "mesh_view.h5", with the fields of the elements.
/// @param path of the mesh file, already written
/// @throws InputError if the folder cannot be written.
void write_xdmf(const std::filesystem::path& path, const MeshFile& file);

}  // namespace flexneck::mesher
