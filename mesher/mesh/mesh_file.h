// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "geometry/foundation/hdf5_file.h"
#include "geometry/foundation/provenance.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// The layout is described in mesher/mesh/README.md.
inline constexpr FileFormat kMeshFormat{"flexneck mesh", 2, "flexneck mesh"};

struct MeshFile {
  Mesh mesh;
  Provenance provenance;
};

void write_mesh(const std::filesystem::path& path, const MeshFile& file);
/// @throws InputError if the file is missing, truncated, foreign or fails check().
MeshFile read_mesh(const std::filesystem::path& path);

}  // namespace flexneck::mesher
