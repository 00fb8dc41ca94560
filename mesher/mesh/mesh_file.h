// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <vector>

#include "geometry/foundation/hdf5_file.h"
#include "geometry/foundation/provenance.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// Format of a mesh file; the layout is described in pipeline/manual/reference/mesh_file.md.
inline constexpr FileFormat kMeshFormat{"flexneck mesh", 4, "flexneck mesh"};

struct MeshFile {
  Mesh mesh;
  Provenance provenance;
  /// By number of processes: the process of each element, blocks in the mesh's order.
  std::map<int, std::vector<std::int32_t>> partitions = {};
  std::vector<std::int32_t> node_order = {};  ///< entry k is the node eliminated k-th; may be empty
};

/// @throws InputError if the mesh fails check(), a partition does not fit its elements or the order
/// is no permutation of its nodes.
void write_mesh(const std::filesystem::path& path, const MeshFile& file);
/// @throws InputError if the file is missing, truncated, foreign, or its content fails the checks
/// of write_mesh().
MeshFile read_mesh(const std::filesystem::path& path);

}  // namespace flexneck::mesher
