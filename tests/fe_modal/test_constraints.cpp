// SPDX-License-Identifier: GPL-3.0-or-later
// Constraints, masses and springs against dense matrices in a basis of the null space of all
// constraint equations, which are implemented independently.
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "fe_modal/analysis/modal_analysis.h"
#include "geometry/foundation/error.h"
#include "tests/fe_modal/dense_constraints.h"
#include "tests/support/block_mesh.h"

namespace flexneck::fe_modal {
namespace {

using Catch::Matchers::Contains;

/// Relative difference of two solutions of the same small problem in double precision.
constexpr double kSame = 1e-9;

/// A rubber block without any symmetry, with the sets "bottom" and "top".
mesher::Mesh block() {
  testing::BlockMesh box = testing::box({1, 1, 2}, {1, 1, 1}, {"rubber", 8.3e6, 0.45, 950});
  box.position = [](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return 0.3 * testing::distorted(p).cwiseProduct(Eigen::Vector3d(0.4, 0.5, 1));
  };
  return box.make();
}

/// Frequencies in Hz of the dense model, including those of rigid motions.
Eigen::VectorXd dense_frequencies(const mesher::Mesh& mesh) {
  const DenseConstraints model = dense_model(mesh);
  const Eigen::MatrixXd basis = allowed_motions(model);
  return testing::dense_pairs(basis.transpose() * model.stiffness * basis,
                              basis.transpose() * model.mass * basis)
             .values.cwiseMax(0)
             .cwiseSqrt() /
         (2 * std::numbers::pi);
}

mesher::AxisSystem axes(const Eigen::Vector3d& z, bool is_cylindrical) {
  return {{-0.4, 0.1, 0.05}, mesher::axes_from(z, Eigen::Vector3d::Zero()), is_cylindrical};
}

/// Checks that the modes are those of the dense matrices, orthonormal in the mass of the
/// invariants.
void check_modes(const mesher::Mesh& mesh, Eigen::Index rigid_count) {
  ModalOptions options;
  options.mode_count = 8;
  const ModalBody body = analyse_modes(mesh, options, {});
  const Eigen::VectorXd expected = dense_frequencies(mesh).segment(rigid_count, 8 - rigid_count);
  if (rigid_count > 0) CHECK(body.frequencies_Hz.head(rigid_count).isZero(0));
  const Eigen::VectorXd found = body.frequencies_Hz.tail(8 - rigid_count);
  CAPTURE(found.transpose(), expected.transpose());
  CHECK((found.array() / expected.array() - 1).abs().maxCoeff() < kSame);
  CHECK(body.orthogonality < kSame);
}

mesher::Mesh with_coupling(const std::array<bool, 3>& directions) {
  mesher::Mesh mesh = block();
  mesh.connections.points = {{"tip", {0.02, 0.03, 0.36}}};
  mesh.connections.couplings = {{"coupling 'tip'", 0, mesh.node_set("top").nodes, directions}};
  return mesh;
}

}  // namespace

TEST_CASE("supports in oblique and cylindrical directions leave the modes of the null space") {
  mesher::Mesh mesh = block();
  SECTION("oblique, fixed") {
    mesh.connections.supports = {
        {"a", mesh.node_set("bottom").nodes, {false, true, true}, axes({1, 2, 3}, false)},
        {"b", mesh.node_set("top").nodes, {false, false, true}, axes({-1, 0.5, 0.2}, false)}};
    check_modes(mesh, 0);
  }
  SECTION("cylindrical: the body turns about the axis and slides along it") {
    mesh.connections.supports = {
        {"a", mesh.node_set("bottom").nodes, {true, false, false}, axes({0.2, -0.1, 1}, true)}};
    check_modes(mesh, 2);
  }
  SECTION("two supports share nodes and a direction") {
    mesh.connections.supports = {
        {"a", mesh.node_set("bottom").nodes, {true, true, false}, axes({1, 2, 3}, false)},
        {"b", mesh.node_set("bottom").nodes, {true, false, true}, axes({1, 2, 3}, false)}};
    check_modes(mesh, 0);
  }
}

TEST_CASE("couplings with masses, also held and in some directions, leave those modes too") {
  SECTION("a mass with inertia, off the point, of a free body") {
    mesher::Mesh mesh = with_coupling({true, true, true});
    mesh.connections.masses = {
        {"m", 0, 2.5, {0.05, -0.02, 0.1}, {0.02, 0.03, 0.025, 0.003, -0.002, 0.004}}};
    mesh.connections.masses[0].site = mesher::translation_site(mesh.nodes.size(), 0);
    check_modes(mesh, 6);
    // Mass and moments of inertia of the whole about the origin are those of the block, and the
    // parallel axis terms of the mass.
    ModalOptions options;
    options.mode_count = 6;
    const ModalBody body = analyse_modes(mesh, options, {});
    mesh.connections = {};
    const InertiaInvariants bare = analyse_modes(mesh, options, {}).invariants;
    const Eigen::Vector3d at(0.07, 0.01, 0.46);
    CHECK(body.invariants.mass == Approx(bare.mass + 2.5).epsilon(1e-12));
    CHECK((body.invariants.S1 - bare.S1 - 2.5 * at).norm() < 1e-12);
    Eigen::Matrix3d inertia;
    inertia << 0.02, 0.003, -0.002, 0.003, 0.03, 0.004, -0.002, 0.004, 0.025;
    inertia += 2.5 * (at.squaredNorm() * Eigen::Matrix3d::Identity() - at * at.transpose());
    CHECK((body.invariants.J0 - bare.J0 - inertia).norm() < 1e-12);
  }
  SECTION("a plane of symmetry through the coupling, and a pin at its point") {
    mesher::Mesh mesh = with_coupling({true, true, true});
    const std::int32_t site = mesher::translation_site(mesh.nodes.size(), 0);
    mesh.connections.supports = {
        {"plane", mesh.node_set("top").nodes, {false, true, false}, axes({0, 0, 1}, false)}};
    mesh.connections.equations = {{"pin", {{site, {1, 0.2, 0}}}}, {"pin", {{site, {0, 0, 1}}}}};
    check_modes(mesh, 1);
  }
  SECTION("in some directions") {
    mesher::Mesh mesh = with_coupling({true, false, true});
    mesh.connections.supports = {{"a", mesh.node_set("bottom").nodes}};
    check_modes(mesh, 0);
  }
}

TEST_CASE("equations in a chain with a coupling, and springs, leave those modes too") {
  mesher::Mesh mesh = with_coupling({true, true, true});
  mesher::Connections& connections = mesh.connections;
  const std::int32_t tip = mesher::translation_site(mesh.nodes.size(), 0);
  const std::vector<std::int32_t>& bottom = mesh.node_set("bottom").nodes;
  // A second point follows the tip with a gear; nodes of the bottom follow the second point.
  connections.points.push_back({"second", {0, 0, -0.1}});
  const std::int32_t second = mesher::translation_site(mesh.nodes.size(), 1);
  connections.couplings.push_back(
      {"coupling 'second'", 1, {bottom.begin(), bottom.begin() + 3}, {true, true, true}});
  connections.equations = {
      {"gear", {{second, {1, 0, 0}}, {tip, {-0.5, 0.1, 0}}, {tip + 1, {0, 0.07, 0}}}},
      {"chain", {{bottom[5], {0, 0, 2}}, {bottom[7], {0.3, 0, 1}}}},
      {"end", {{bottom[7], {1, 0, 0}}, {second + 1, {0, 0, 0.2}}}}};
  connections.springs = {{"to ground", {{bottom[8], {0.6, 0, 0.8}}}, 3000},
                         {"between", {{bottom[8], {0, 1, 0}}, {tip, {0, -1, 0}}}, 5000},
                         {"torsion", {{tip + 1, {0, 0, 1}}, {second + 1, {0, 0, -1}}}, 40}};
  connections.masses = {{"at a node", bottom[8], 0.7, {}, {}}};
  ModalOptions options;
  options.mode_count = 8;
  const ModalBody body = analyse_modes(mesh, options, {});
  const Eigen::VectorXd expected = dense_frequencies(mesh);
  const Eigen::Index rigid = (expected.array() < 1e-3).count();
  CAPTURE(rigid, body.boundary, expected.head(8).transpose(), body.frequencies_Hz.transpose());
  CHECK((body.frequencies_Hz.array() == 0).count() == rigid);
  CHECK(
      (body.frequencies_Hz.tail(8 - rigid).array() / expected.segment(rigid, 8 - rigid).array() - 1)
          .abs()
          .maxCoeff() < kSame);
  CHECK(body.orthogonality < kSame);
}

TEST_CASE("a mass that hangs on springs alone moves as softly as they are") {
  mesher::Mesh mesh = block();
  mesh.connections.points = {{"mass", {0, 0, 0.5}}};
  mesh.connections.supports = {{"a", mesh.node_set("bottom").nodes}};
  const std::int32_t site = mesher::translation_site(mesh.nodes.size(), 0);
  const std::int32_t node = mesh.node_set("top").nodes.front();
  for (std::size_t a = 0; a < 3; ++a) {
    mesher::Spring spring{"s", {{site, {}}, {node, {}}}, 1e4};
    spring.terms[0].coefficients[a] = 1;
    spring.terms[1].coefficients[a] = -1;
    mesh.connections.springs.push_back(spring);
  }
  mesh.connections.masses = {{"m", site, 4, {}, {}}};
  check_modes(mesh, 0);
  // The springs are so soft that mechanisms of the body would be as slow. The compliance of the
  // block in bending, 1e-4 m/N, times their stiffness is the tolerance.
  constexpr double kBlockGives = 1e-5;
  for (mesher::Spring& spring : mesh.connections.springs) spring.stiffness = 0.1;
  ModalOptions options;
  options.mode_count = 3;
  const ModalBody body = analyse_modes(mesh, options, {});
  const double single_Hz = std::sqrt(0.1 / 4) / (2 * std::numbers::pi);
  CHECK((body.frequencies_Hz.array() / single_Hz - 1).abs().maxCoeff() < kBlockGives);

  mesh.connections.springs.pop_back();
  CHECK_THROWS_WITH(analyse_modes(mesh, options, {}),
                    Contains("mass carries a mass with an unconstrained motion"));
}

TEST_CASE("constraints that cannot be are refused in one line that names them") {
  mesher::Mesh mesh = block();
  mesher::Connections& connections = mesh.connections;
  const auto refusal = [&]() -> std::string {
    try {
      static_cast<void>(analyse_modes(mesh, {}, {}));
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  const mesher::Term one{3, {1, 0, 0}};
  const mesher::Term two{4, {-2, 0, 0}};
  SECTION("cycle") {
    connections.equations = {{"equation 'a'", {one, two}}, {"equation 'b'", {two, one}}};
    connections.equations[1].terms[1].coefficients = {3, 0, 0};
    CHECK_THAT(refusal(),
               Contains("equation 'b' and equation 'a' form a cycle: x of the node at ("));
  }
  SECTION("contradiction") {
    connections.equations = {{"equation 'a'", {one, two}}, {"equation 'b'", {one, {5, {1, 0, 0}}}}};
    CHECK_THAT(refusal(),
               Contains("equation 'b' and equation 'a' contradict each other: both determine x"));
  }
  SECTION("the same twice is none") {
    connections.equations = {{"equation 'a'", {one, two}}, {"equation 'b'", {one, two}}};
    CHECK(refusal() == "accepted");
  }
  SECTION("a coupling without nodes") {
    connections.points = {{"p", {}}};
    connections.couplings = {{"coupling 'p'", 0, {}}};
    CHECK(refusal() == "mesh: coupling 'p' has no nodes");
  }
  SECTION("no direction") {
    connections.supports = {{"support 's'", {1}, {false, false, false}}};
    CHECK(refusal() == "mesh: support 's' has no direction");
  }
  SECTION("a zero direction") {
    connections.equations = {{"support 's'", {{2, {0, 0, 0}}}}};
    CHECK_THAT(refusal(), Contains("support 's' has a term whose direction is zero"));
  }
  SECTION("a node on the axis of its cylindrical directions") {
    connections.supports = {{"support 's'", {0}, {true, false, false}}};
    connections.supports[0].axes.is_cylindrical = true;
    connections.supports[0].axes.origin_m = point_of(mesh.nodes[0]);
    CHECK_THAT(refusal(), Contains("support 's': a node on the axis of a cylindrical axis system"));
  }
}

}  // namespace flexneck::fe_modal
