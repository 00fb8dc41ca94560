// SPDX-License-Identifier: GPL-3.0-or-later
// Target: Abaqus or CalculiX input.
#include <cmath>

#include "mesher/exchange/import_check.h"
#include "mesher/exchange/inp_import.h"
#include "mesher/mesh/mesh.h"
#include "tests/reliability/fuzz/input_folder.h"

using namespace flexneck;
using namespace flexneck::mesher;

namespace {

void check_nodes(const std::vector<std::int32_t>& nodes, const Mesh& mesh) {
  for (const std::int32_t node : nodes)
    fuzz::require(node >= 0 && static_cast<std::size_t>(node) < mesh.nodes.size(),
                  "a node of an element or set is one of the mesh");
}

void check_mesh(const Mesh& mesh) {
  for (const auto& node : mesh.nodes)
    for (const double x : node) fuzz::require(std::isfinite(x), "a node is somewhere");
  for (const ElementBlock& block : mesh.blocks) {
    fuzz::require(block.material < mesh.materials.size(), "a part has a material");
    fuzz::require(
        block.size() > 0 && block.nodes.size() == block.size() * nodes_per_element(block.kind),
        "a block has whole elements");
    check_nodes(block.nodes, mesh);
  }
  for (const NodeSet& set : mesh.node_sets) check_nodes(set.nodes, mesh);
  for (const FaceSet& set : mesh.face_sets)
    for (const FaceBlock& block : set.blocks) check_nodes(block.nodes, mesh);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFolder folder;
  ImportOptions options;
  options.file = folder.with("deck.inp", fuzz::text_of(data, size));
  options.length_unit_m = 1e-3;
  return fuzz::try_reader([&] {
    LeftOut left_out;
    // The same calls as in import_mesh().
    const Mesh mesh = import_inp(options, {}, left_out);
    check(mesh);
    check_import(mesh, false);
    check_mesh(mesh);
    fuzz::require(left_out.empty() == left_out.text().empty(), "what is left out is told");
  });
}
