// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cstdint>
#include <functional>
#include <string>

#include <catch2/catch.hpp>

#include "fe_modal/analysis/modal_analysis.h"
#include "geometry/foundation/error.h"
#include "tests/support/block_mesh.h"
#include "tests/support/element_meshes.h"

namespace flexneck::fe_modal {
namespace {

using Catch::Matchers::Contains;

constexpr double kHeight = 0.1;  // height of the joint

/// A pin on a post, joined at the positions for which `bonded` is true.
mesher::Mesh post_and_pin(const std::function<bool(const Eigen::Vector3d&)>& bonded) {
  const mesher::Material steel{"steel", 2.1e11, 0.3, 7850};
  testing::BlockMesh block = testing::box({2, 2, 1}, {0.1, 0.1, 2 * kHeight}, {});
  block.slices = {{"post", 2, steel}, {"pin", 2, {"brass", 1e11, 0.34, 8500}}};
  mesher::Mesh mesh = testing::with_slit(
      block.make(), kHeight, false,
      [&](const Eigen::Vector3d& x) { return std::abs(x[2] - kHeight) < 1e-9 && !bonded(x); });
  mesh.slits.clear();
  return mesh;
}

std::string refusal(const mesher::Mesh& mesh, const std::string& fixed) {
  ModalOptions options;
  options.fixed_set = fixed;
  options.mode_count = 8;
  try {
    static_cast<void>(analyse_modes(mesh, options, {}));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("a hinge is named with its part and its axis, fixed or free") {
  const mesher::Mesh mesh =
      post_and_pin([](const Eigen::Vector3d& x) { return std::abs(x[0] - 0.05) < 1e-9; });
  CHECK_THAT(refusal(mesh, "bottom"),
             Contains("mechanism: part 'pin' rotates freely about y through (0.05, 0, 0.1) m;"));
  CHECK_THAT(refusal(mesh, "top"),
             Contains("mechanism: part 'post' rotates freely about y through (0.05, 0, 0.1) m;"));
  // The pin of brass is heavier, so the post moves relative to it.
  CHECK_THAT(refusal(mesh, ""), Contains("part 'post' rotates freely about y"));
}

TEST_CASE("a part that hangs by a point, or by nothing, is named") {
  CHECK_THAT(
      refusal(post_and_pin([](const Eigen::Vector3d& x) { return x.head<2>().norm() < 1e-9; }),
              "bottom"),
      Contains("part 'pin' moves freely in 3 independent ways"));
  CHECK_THAT(refusal(post_and_pin([](const Eigen::Vector3d&) { return false; }), "bottom"),
             Contains("part 'pin' is not fixed: it can move freely in all six degrees of freedom"));
}

TEST_CASE("nodes a little off the axis of a hinge hold the body, as the square of their distance") {
  // Such deviations occur in a file with rounded coordinates.
  const auto frequency_Hz = [](double off_axis_m) {
    testing::BlockMesh box =
        testing::box({2, 1, 2}, {0.1, 0.02, 0.2}, {"steel", 2.1e11, 0.3, 7850});
    mesher::Mesh mesh = box.make();
    mesher::NodeSet held{"held", {}};
    for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
      std::array<double, 3>& position = mesh.nodes[node];
      if (position[1] > -0.009 || position[2] > 1e-9) continue;  // the edge along x
      position[2] += off_axis_m * (held.nodes.size() % 2 == 0 ? 1 : -1);
      held.nodes.push_back(static_cast<std::int32_t>(node));
    }
    mesh.node_sets.push_back(held);
    ModalOptions options;
    options.fixed_set = "held";
    options.mode_count = 4;
    return analyse_modes(mesh, options, {}).frequencies_Hz[0];
  };
  CHECK(frequency_Hz(0) == 0);
  const double reference = frequency_Hz(1e-5) / 1e-5;
  CHECK(frequency_Hz(1e-6) / 1e-6 == Approx(reference).epsilon(1e-3));
  CHECK(frequency_Hz(5e-7) / 5e-7 == Approx(reference).epsilon(1e-3));
}

TEST_CASE("parts that hang together are no mechanism") {
  CHECK(refusal(post_and_pin([](const Eigen::Vector3d& x) { return x[0] < 0.01; }), "bottom") ==
        "accepted");
}

}  // namespace flexneck::fe_modal
