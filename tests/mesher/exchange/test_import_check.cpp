// SPDX-License-Identifier: GPL-3.0-or-later
#include <functional>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "mesher/exchange/import_check.h"
#include "tests/mesher/small_mesh.h"

namespace flexneck::mesher {
namespace {

using Catch::Matchers::Contains;

std::string refusal(const std::function<void(Mesh&)>& change, bool keeps_doubles = false) {
  Mesh mesh = testing::small_mesh();
  change(mesh);
  try {
    check_import(mesh, keeps_doubles);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

/// Appends a copy of a block with nodes of its own, moved upwards.
void append_copy(Mesh& mesh, std::size_t block, double up_m) {
  ElementBlock copy = mesh.blocks[block];
  copy.part = "copy";
  for (std::int32_t& node : copy.nodes) {
    auto x = mesh.nodes[static_cast<std::size_t>(node)];
    x[2] += up_m;
    node = static_cast<std::int32_t>(mesh.nodes.size());
    mesh.nodes.push_back(x);
  }
  mesh.blocks.push_back(std::move(copy));
}

}  // namespace

TEST_CASE("a sound mesh is accepted") {
  CHECK(refusal([](Mesh&) {}) == "accepted");
}

TEST_CASE("elements on the nodes of others are counted and placed") {
  CHECK_THAT(refusal([](Mesh& mesh) {
               mesh.blocks.push_back(mesh.blocks[0]);
               mesh.blocks.back().part = "copy";
             }),
             Contains("1 elements have the same nodes as others") &&
                 Contains("part 'copy' near (0.5, 0.5, 1.5) m"));
}

TEST_CASE("nodes in the place of others are counted, within rounding and no further") {
  const auto shifted = [](double up_m) {
    return [up_m](Mesh& mesh) { append_copy(mesh, 0, up_m); };
  };
  CHECK_THAT(refusal(shifted(0)),
             Contains("27 nodes coincide with others") && Contains("coincident_nodes = \"keep\""));
  CHECK_THAT(refusal(shifted(1e-9)), Contains("27 nodes"));
  CHECK_THAT(refusal(shifted(1)), Contains("9 nodes") && Contains("2) m"));  // one face
  CHECK_THAT(refusal(shifted(1 + 1e-6)), Contains("unconnected pieces"));
}

TEST_CASE("pieces that share no node are counted, also where doubles are kept") {
  CHECK_THAT(refusal([](Mesh& mesh) { append_copy(mesh, 0, 1); }, true),
             Contains("consists of 2 unconnected pieces") &&
                 Contains("part 'copy' near (0.5, 0.5, 2.5) m"));
  CHECK_THAT(refusal([](Mesh& mesh) {
               append_copy(mesh, 0, 3);
               mesh.blocks.back().part = "one";
               append_copy(mesh, 0, 6);
             }),
             Contains("consists of 3 unconnected pieces"));
}

TEST_CASE("inverted elements are counted by part, and a mirror image is told as such") {
  CHECK_THAT(refusal([](Mesh& mesh) {
               for (auto& node : mesh.nodes) node[0] = -node[0];
             }),
             Contains("part 'upper': 1 of 1 elements (hex27)") && Contains("the mesh is mirrored"));
  CHECK_THAT(refusal([](Mesh& mesh) {
               mesh.blocks[1].nodes.insert(mesh.blocks[1].nodes.end(), mesh.blocks[0].nodes.begin(),
                                           mesh.blocks[0].nodes.end());
               mesh.blocks.erase(mesh.blocks.begin());
               mesh.nodes[44][2] = 0.2;  // a corner of the upper element, pushed through it
             }),
             Contains("part 'lower': 1 of 2 elements") && Contains("repair the mesh"));
}

}  // namespace flexneck::mesher
