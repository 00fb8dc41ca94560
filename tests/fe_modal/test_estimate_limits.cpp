// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "fe_modal/analysis/estimate_limits.h"
#include "fe_modal/analysis/modal_analysis.h"
#include "tests/support/block_mesh.h"
#include "tests/support/element_meshes.h"

namespace flexneck::fe_modal {
namespace {

using Catch::Matchers::Contains;

const mesher::Material kSteel{"steel", 2.1e11, 0.3, 7850};

ModalOptions fixed(const std::string& set) {
  ModalOptions options;
  options.fixed_set = set;
  return options;
}

}  // namespace

TEST_CASE("errors are an indication alone above the aspect ratios for which they were shown") {
  const mesher::Mesh cubes = testing::box({1, 1, 4}, {0.1, 0.1, 0.4}, kSteel).make();
  CHECK(limits_of_estimate(cubes, fixed("bottom")).empty());
  const mesher::Mesh beam = testing::with_kind(
      testing::box({1, 1, 8}, {0.01, 0.01, 0.8}, kSteel).make(), mesher::ElementKind::hex20);
  CHECK_THAT(limits_of_estimate(beam, fixed("bottom")),
             Contains("part 'block' has elements 10 times as long as thick"));
  // Against eight elements in place of each.
  ModalOptions options = fixed("bottom");
  options.mode_count = 8;
  options.check = true;
  const ModalBody body = analyse_modes(beam, options, {});
  CHECK_FALSE(body.mesh_error_limits.empty());
  const mesher::Mesh fine = testing::with_kind(
      testing::box({4, 4, 32}, {0.01, 0.01, 0.8}, kSteel).make(), mesher::ElementKind::hex20);
  options.check = false;
  const double truth = analyse_modes(fine, options, {}).frequencies_Hz[7];
  const double error = body.frequencies_Hz[7] / truth - 1;
  CHECK(body.modes[7].mesh_error->error > 0.7 * error);
  CHECK(body.modes[7].mesh_error->error < 5 * error);
}

TEST_CASE("what single nodes hold or load is named by its set, whole faces are not") {
  mesher::Mesh mesh = testing::box({4, 4, 1}, {1, 1, 1}, kSteel).make();
  CHECK(held_at_single_nodes(mesh, fixed("bottom")).empty());
  const std::vector<std::int32_t> bottom = mesh.node_set("bottom").nodes;
  mesh.node_sets.push_back({"corners", {bottom[0], bottom[8], bottom[72], bottom[80]}});
  mesh.node_sets.push_back({"edge", {bottom.begin(), bottom.begin() + 9}});
  // A face of nine nodes, one beside it, and a node of the far side.
  mesh.node_sets.push_back({"patch",
                            {bottom[0], bottom[1], bottom[2], bottom[9], bottom[10], bottom[11],
                             bottom[18], bottom[19], bottom[20], bottom[12], bottom[80]}});
  using Lines = std::vector<std::string>;
  CHECK(held_at_single_nodes(mesh, fixed("corners")) == Lines{"node set 'corners' (4 nodes)"});
  CHECK(held_at_single_nodes(mesh, fixed("edge")) == Lines{"node set 'edge' (9 nodes)"});
  const Lines patch = held_at_single_nodes(mesh, fixed("patch"));
  REQUIRE(patch.size() == 1);
  CHECK_THAT(patch[0], Contains("node set 'patch' (") && Contains(" of its 11 nodes)"));
  mesh.connections.springs = {{"s", {{bottom[3], {1, 0, 0}}, {bottom[4], {-1, 0, 0}}}, 10}};
  CHECK(held_at_single_nodes(mesh, fixed("bottom")) == Lines{"springs (2 nodes)"});
  CHECK(loaded_at_single_nodes(mesh, {{"pull", NodeLoad{"corners", {}, {1, 0, 0}}},
                                      {"press", NodeLoad{"bottom", {}, {1, 0, 0}}}}) ==
        Lines{"load 'pull' (4 nodes)"});
}

}  // namespace flexneck::fe_modal
