// SPDX-License-Identifier: GPL-3.0-or-later
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

constexpr double kHeight = 0.1;  // of the joint

/// A pin on a post, which hang together where `bonded` says so.
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
             Contains("mechanism: part 'pin' turns freely about y through (0.05, 0, 0.1) m;"));
  CHECK_THAT(refusal(mesh, "top"),
             Contains("mechanism: part 'post' turns freely about y through (0.05, 0, 0.1) m;"));
  // The pin of brass is heavier, so the post moves against it.
  CHECK_THAT(refusal(mesh, ""), Contains("part 'post' turns freely about y"));
}

TEST_CASE("a part that hangs by a point, or by nothing, is named") {
  CHECK_THAT(
      refusal(post_and_pin([](const Eigen::Vector3d& x) { return x.head<2>().norm() < 1e-9; }),
              "bottom"),
      Contains("part 'pin' moves freely in 3 ways"));
  CHECK_THAT(refusal(post_and_pin([](const Eigen::Vector3d&) { return false; }), "bottom"),
             Contains("part 'pin' is not fixed: it moves freely in every way"));
}

TEST_CASE("parts that hang together are no mechanism") {
  CHECK(refusal(post_and_pin([](const Eigen::Vector3d& x) { return x[0] < 0.01; }), "bottom") ==
        "accepted");
}

}  // namespace flexneck::fe_modal
