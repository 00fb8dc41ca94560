// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <catch2/catch.hpp>

#include "fe_modal/analysis/modal_analysis.h"
#include "tests/support/block_mesh.h"
#include "tests/support/element_choices.h"

namespace flexneck::fe_modal {
namespace {

constexpr double kLength = 0.8;

/// A bar fixed at the bottom, with its motion observed at the top.
ModalBody bar(const Eigen::Vector2d& section, double turned_rad = 0) {
  testing::BlockMesh block = testing::box({2, 2, 4}, {section[0], section[1], kLength}, kSteel);
  const auto straight = block.position;
  block.position = [=](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    const Eigen::Vector3d x = straight(p);
    const double c = std::cos(turned_rad), s = std::sin(turned_rad);
    return {c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]};
  };
  ModalOptions options;
  options.mode_count = 6;
  options.fixed_set = "bottom";
  options.interfaces = {{"tip", "top", {0, 0, kLength}}};
  options.rigid_parts = {"block"};
  options.sign_interface = "tip";
  options.length_m = kLength;
  return analyse_modes(block.make(), options, {});
}

}  // namespace

TEST_CASE("the exactly double bending of a square bar is turned to the axes") {
  // Rotated by any angle about its axis the bar still has double frequencies, so its modes must
  // follow x and y.
  constexpr double kPure = 1e-6;
  for (const double angle : {0.0, 0.3}) {
    const ModalBody body = bar({0.05, 0.05}, angle);
    REQUIRE(std::abs(body.frequencies_Hz[1] / body.frequencies_Hz[0] - 1) < 1e-8);
    CHECK(body.modes[0].name == "fore-aft bending 1");
    CHECK(body.modes[1].name == "lateral bending 1");
    const Interface& tip = body.interface("tip");
    const double motion = tip.translation.col(0).norm();
    CHECK(std::abs(tip.translation(1, 0)) < kPure * motion);
    CHECK(std::abs(tip.translation(0, 1)) < kPure * motion);
    CHECK(body.modes[0].shares_percent[1] < 1e-6);
    CHECK(body.modes[1].shares_percent[0] < 1e-6);
    CHECK(body.orthogonality < 1e-10);
  }
}

TEST_CASE("a pair that is not double keeps its own axes") {
  // The frequencies are 5 % apart: modes follow the principal axes of the section, rotated with it.
  constexpr double kAngle = 0.3;
  const ModalBody body = bar({0.05, 0.0525}, kAngle);
  const Interface& tip = body.interface("tip");
  const double slope = tip.translation(1, 0) / tip.translation(0, 0);
  CHECK(slope == Approx(std::tan(kAngle)).epsilon(1e-5));
}

TEST_CASE("the largest of the tip's translation and length x rotation is positive") {
  const ModalBody body = bar({0.05, 0.07});
  const Interface& tip = body.interface("tip");
  for (Eigen::Index k = 0; k < body.mode_count(); ++k) {
    Eigen::VectorXd motion(6);
    motion << tip.translation.col(k), kLength * tip.rotation.col(k);
    Eigen::Index largest = 0;
    motion.cwiseAbs().maxCoeff(&largest);
    CHECK(motion[largest] > 0);
  }
}

TEST_CASE("a repeated analysis gives the same bits") {
  const ModalBody one = bar({0.05, 0.05}, 0.3);
  const ModalBody other = bar({0.05, 0.05}, 0.3);
  CHECK(one.frequencies_Hz == other.frequencies_Hz);
  for (std::size_t k = 0; k < one.shapes.size(); ++k) CHECK(one.shapes[k] == other.shapes[k]);
}

}  // namespace flexneck::fe_modal
