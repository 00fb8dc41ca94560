// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

enum class MshEncoding { text, binary };

/// Writes gmsh's format 4.1: a physical volume for each part, a physical surface for each face set,
/// a physical point for each node set that is more than the nodes of a face set of its name.
/// Reading the file gives the same mesh, with all bits of the numbers; the study gives the
/// materials.
/// @throws InputError if the file cannot be written, a name has a quote or a line break, or a slit
/// is tied, which the format cannot express.
void write_msh(const std::filesystem::path& file, const Mesh& mesh, MshEncoding encoding);

}  // namespace flexneck::mesher
