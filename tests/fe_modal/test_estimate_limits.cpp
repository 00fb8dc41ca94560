// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <optional>

#include <catch2/catch.hpp>

#include "fe_modal/analysis/estimate_limits.h"
#include "fe_modal/analysis/modal_analysis.h"
#include "mesher/mesh/refinement.h"
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

TEST_CASE("errors are an indication alone of bodies that single nodes hold or load") {
  mesher::Mesh bar = testing::box({1, 1, 4}, {0.1, 0.1, 0.4}, kSteel).make();
  const std::vector<std::int32_t> bottom = bar.node_set("bottom").nodes;
  bar.node_sets.push_back({"corners", {bottom[0], bottom[2], bottom[6], bottom[8]}});
  CHECK(limits_of_estimate(bar, fixed("bottom")).empty());
  CHECK(limits_of_estimate(bar, {}).empty());
  CHECK_THAT(limits_of_estimate(bar, fixed("corners")),
             Contains("single nodes") && Contains("node set 'corners' (4 nodes)"));
  ModalOptions loaded = fixed("bottom");
  loaded.prestress = {{"press", NodeLoad{"top", {}, {0, 0, 1}}}};
  CHECK(limits_of_estimate(bar, loaded).empty());
  loaded.prestress = {{"pull", NodeLoad{"", Eigen::Vector3d(0.05, 0.05, 0.4), {0, 0, 1}}}};
  CHECK_THAT(limits_of_estimate(bar, loaded), Contains("load 'pull' (1 node)"));
}

TEST_CASE("errors are none alone of slender elements and of bodies with a re-entrant edge") {
  const mesher::Mesh slender = testing::with_kind(
      testing::box({1, 1, 8}, {0.01, 0.01, 16}, kSteel).make(), mesher::ElementKind::hex20);
  CHECK(limits_of_estimate(slender, fixed("bottom")).empty());
  const mesher::Mesh angle =
      testing::with_kinds(testing::box({4, 2, 4}, {0.08, 0.04, 0.08}, kSteel).make(),
                          [](const Eigen::Vector3d& x) -> std::optional<mesher::ElementKind> {
                            if (x[0] > -0.02 && x[2] > 0.02) return std::nullopt;
                            return mesher::ElementKind::hex20;
                          });
  CHECK(limits_of_estimate(angle, fixed("bottom")).empty());
  // Comparison with 4 x 4 x 4 elements in place of each shows that the estimates are valid.
  ModalOptions options = fixed("bottom");
  options.mode_count = 3;
  const mesher::Mesh fine = mesher::refine(mesher::refine(angle).mesh).mesh;
  const Eigen::VectorXd truth = analyse_modes(fine, options, {}).frequencies_Hz;
  options.check = true;
  const ModalBody body = analyse_modes(angle, options, {});
  CHECK(body.mesh_error_limits.empty());
  for (Eigen::Index k = 0; k < truth.size(); ++k) {
    const double ratio = body.modes[static_cast<std::size_t>(k)].mesh_error->error /
                         std::abs(body.frequencies_Hz[k] / truth[k] - 1);
    CHECK(ratio > 0.7);
    CHECK(ratio < 5);
  }
}

TEST_CASE("what single nodes hold or load is named by its set, whole faces are not") {
  mesher::Mesh mesh = testing::box({4, 4, 1}, {1, 1, 1}, kSteel).make();
  CHECK(held_at_single_nodes(mesh, fixed("bottom")).empty());
  const std::vector<std::int32_t> bottom = mesh.node_set("bottom").nodes;
  mesh.node_sets.push_back({"corners", {bottom[0], bottom[8], bottom[72], bottom[80]}});
  mesh.node_sets.push_back({"edge", {bottom.begin(), bottom.begin() + 9}});
  // The set has a face of nine nodes, one node beside it, and a node of the far side.
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
