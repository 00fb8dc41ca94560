// SPDX-License-Identifier: GPL-3.0-or-later
// Target: mesh.h5, see hdf5_edits.h.
#include <cmath>
#include <numeric>

#include "mesher/mesh/mesh_file.h"
#include "mesher/mesh/shape_functions.h"
#include "tests/mesher/small_mesh.h"
#include "tests/reliability/fuzz/hdf5_target.h"

using namespace flexneck;
using namespace flexneck::mesher;

namespace {

/// Writes a mesh with an example of everything that such a file may hold.
void write_sound(const std::filesystem::path& path) {
  MeshFile file{testing::small_mesh(), {}};
  // The upper block gets a copy of the corner node 18, which lies between the two blocks.
  file.mesh.nodes.push_back(file.mesh.nodes[18]);
  file.mesh.blocks[0].nodes[0] = 45;
  file.mesh.slits = {{"cut", true, {18}, {45}, {{0, 0, 1}}, {0.125}}};
  file.partitions[2] = {1, 0};
  file.node_order.resize(file.mesh.nodes.size());
  std::iota(file.node_order.rbegin(), file.node_order.rend(), 0);
  file.provenance = {"program",
                     "hash",
                     {{"a.geo", "0"}},
                     {{"key", "1 m", Origin::published, "note"}},
                     {{"gmsh", "4"}}};
  write_mesh(path, file);
}

void check_nodes(const std::vector<std::int32_t>& nodes, const Mesh& mesh) {
  for (const std::int32_t node : nodes)
    fuzz::require(node >= 0 && static_cast<std::size_t>(node) < mesh.nodes.size(),
                  "a node of an element or set is one of the mesh");
}

void check(const MeshFile& file) {
  const Mesh& mesh = file.mesh;
  for (const auto& node : mesh.nodes)
    for (const double x : node) fuzz::require(std::isfinite(x), "a node is somewhere");
  std::size_t elements = 0;
  for (const ElementBlock& block : mesh.blocks) {
    fuzz::require(block.material < mesh.materials.size(), "a part has a material");
    fuzz::require(block.nodes.size() == block.size() * nodes_per_element(block.kind),
                  "a block has whole elements");
    check_nodes(block.nodes, mesh);
    elements += block.size();
  }
  for (const NodeSet& set : mesh.node_sets) check_nodes(set.nodes, mesh);
  for (const FaceSet& set : mesh.face_sets)
    for (const FaceBlock& block : set.blocks) check_nodes(block.nodes, mesh);
  for (const Slit& slit : mesh.slits) {
    check_nodes(slit.lower, mesh);
    check_nodes(slit.upper, mesh);
    fuzz::require(
        slit.lower.size() == slit.normals.size() && slit.lower.size() == slit.areas_m2.size(),
        "a slit has a normal and an area for each pair");
    for (const auto& normal : slit.normals)
      fuzz::require(std::abs(std::hypot(normal[0], normal[1], normal[2]) - 1) < 1e-6,
                    "normals are unit vectors");
  }
  for (const auto& [count, processes] : file.partitions)
    fuzz::require(count > 0 && processes.size() == elements, "a partition has all elements");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Hdf5Target target(write_sound);
  return target.run(data, size, [](const std::filesystem::path& path) {
    const MeshFile file = read_mesh(path);
    check(file);
    // A foreign file is used in a run after it has been written as a copy of this program.
    const std::filesystem::path copy = target.folder().path() / "copy.h5";
    write_mesh(copy, file);
    const MeshFile again = read_mesh(copy);
    fuzz::require(again.mesh.nodes == file.mesh.nodes && again.partitions == file.partitions &&
                      again.mesh.blocks.size() == file.mesh.blocks.size() &&
                      again.mesh.slits.size() == file.mesh.slits.size(),
                  "a mesh is written and read");
  });
}
