// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>
#include <utility>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "mesher/mesh/element_kind.h"
#include "mesher/mesh/node_velocity.h"
#include "mesher/mesh/shape_functions.h"
#include "tests/mesher/small_mesh.h"

namespace flexneck::mesher {
namespace {

using Catch::Matchers::Contains;

/// The small mesh with its heights raised to a power: z^p.
Mesh with_power(double p) {
  Mesh mesh = testing::small_mesh();
  for (auto& node : mesh.nodes) node[2] = std::pow(node[2], p);
  return mesh;
}

}  // namespace

TEST_CASE("nodes move with a parameter as the quotient of their differences") {
  const Mesh mesh = with_power(1);
  constexpr double kStep = 1e-3;
  const Eigen::Matrix3Xd velocity =
      node_velocity(mesh, with_power(1 - kStep), with_power(1 + kStep), 2 * kStep);
  for (Eigen::Index k = 0; k < velocity.cols(); ++k) {
    const double z = mesh.nodes[static_cast<std::size_t>(k)][2];
    CHECK(velocity(0, k) == 0);
    // d z^p / dp = z ln z at p = 1; the error is of second order.
    CHECK(velocity(2, k) == Approx(z > 0 ? z * std::log(z) : 0).margin(1e-6));
  }
}

TEST_CASE("nodes of another topology have no velocity, and a line tells what differs") {
  const Mesh mesh = testing::small_mesh();
  const auto refusal = [&](const Mesh& other) -> std::string {
    try {
      static_cast<void>(node_velocity(mesh, other, mesh, 1));
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  CHECK(refusal(mesh) == "none");
  Mesh more = mesh;
  more.nodes.push_back({0, 0, 0});
  CHECK_THAT(refusal(more), Contains("(45 nodes become 46)"));
  Mesh turned = mesh;
  std::swap(turned.blocks[1].nodes[0], turned.blocks[1].nodes[1]);
  CHECK_THAT(refusal(turned), Contains("(parts: 'lower')"));
  Mesh bare = mesh;
  bare.face_sets.clear();
  CHECK_THAT(refusal(bare), Contains("(face sets: their number)"));
  Mesh cut = mesh;
  cut.slits.push_back({"slit", false, {0}, {1}, {{0, 0, 1}}, {0}});
  CHECK_THAT(refusal(cut), Contains("(slits: their number)"));
  Mesh chosen = mesh;
  chosen.node_sets[0].nodes.pop_back();
  CHECK(refusal(chosen) == "none");
}

}  // namespace flexneck::mesher
