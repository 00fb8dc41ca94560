// SPDX-License-Identifier: GPL-3.0-or-later
// The rigid motions that a body keeps depend neither on its position nor on the size of its
// coefficients: comparison with the same body at the origin, and with dense matrices in the null
// space.
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/analysis/static_analysis.h"
#include "tests/fe_modal/dense_constraints.h"
#include "tests/support/block_mesh.h"

namespace flexneck::fe_modal {
namespace {

const mesher::Material kSteel{"steel", 2.1e11, 0.3, 7850};

ModalOptions eight_modes() {
  ModalOptions options;
  options.mode_count = 8;
  return options;
}

mesher::Mesh moved(mesher::Mesh mesh, const Eigen::Vector3d& by_m) {
  const auto move = [&](std::array<double, 3>& x) {
    for (std::size_t a = 0; a < 3; ++a) x[a] += by_m[static_cast<Eigen::Index>(a)];
  };
  for (std::array<double, 3>& node : mesh.nodes) move(node);
  for (mesher::ReferencePoint& point : mesh.connections.points) move(point.position_m);
  return mesh;
}

/// A leaf 1/100 as thick as it is long.
mesher::Mesh leaf() { return testing::box({2, 1, 4}, {0.002, 0.0002, 0.02}, kSteel).make(); }

void check_the_same(const ModalBody& found, const ModalBody& expected) {
  CAPTURE(found.boundary, found.frequencies_Hz.transpose(), expected.frequencies_Hz.transpose());
  CHECK(found.boundary == expected.boundary);
  CHECK((found.frequencies_Hz - expected.frequencies_Hz).norm() <
        1e-6 * expected.frequencies_Hz[0] + 1e-6 * expected.frequencies_Hz.norm());
}

/// Compares with the dense model, rotations as lengths.
void check_against_null_space(const mesher::Mesh& mesh, Eigen::Index rigid) {
  DenseConstraints model = dense_model(mesh);
  for (Eigen::VectorXd& row : model.equations) row.normalize();
  const Eigen::MatrixXd basis = allowed_motions(model);
  const Eigen::MatrixXd mass = basis.transpose() * model.mass * basis;
  const Eigen::MatrixXd stiffness = basis.transpose() * model.stiffness * basis;
  const Eigen::VectorXd expected =
      testing::lowest_values(stiffness + 1e6 * mass, mass, 8).array() - 1e6;
  const ModalBody body = analyse_modes(mesh, eight_modes(), {});
  const Eigen::VectorXd values = (2 * std::numbers::pi * body.frequencies_Hz.array()).square();
  CAPTURE(body.boundary, values.transpose(), expected.transpose());
  CHECK((values.array() == 0).count() == rigid);
  CHECK((values - expected).cwiseAbs().maxCoeff() < 1e-8 * expected[7]);
}

}  // namespace

TEST_CASE("a clamped leaf has no rigid motion, and the same modes, wherever it stands") {
  ModalOptions options = eight_modes();
  options.fixed_set = "bottom";
  const ModalBody expected = analyse_modes(leaf(), options, {});
  CHECK(expected.frequencies_Hz[0] > 1);
  for (const double distance_m : {2.0, 200.0, 2e4}) {
    const mesher::Mesh far = moved(leaf(), {distance_m, -0.7 * distance_m, 0.6 * distance_m});
    check_the_same(analyse_modes(far, options, {}), expected);
    CHECK_NOTHROW(analyse_static(far, options, {{"g", GravityLoad{{0, 0, -9.81}}}}, {}));
  }
}

TEST_CASE("a body keeps what its supports leave of rigid motions, wherever it stands") {
  ModalOptions options = eight_modes();
  const auto cylindrical = [](const Eigen::Vector3d& center_m) {
    mesher::Mesh mesh = testing::tube({1, 8, 2}, 0.04, 0.06, 0.1, kSteel).make();
    mesh.connections.supports = {{"ring", mesh.node_set("bottom").nodes, {true, false, false}}};
    mesh.connections.supports[0].axes.is_cylindrical = true;
    mesh.connections.supports[0].axes.origin_m = center_m;
    return moved(std::move(mesh), center_m);
  };
  const ModalBody expected = analyse_modes(cylindrical(Eigen::Vector3d::Zero()), options, {});
  CHECK((expected.frequencies_Hz.array() == 0).count() ==
        4);  // translation along the axis, rotations about all axes
  for (const double distance_m : {20.0, 5e5})
    check_the_same(analyse_modes(cylindrical({distance_m, 10 * distance_m, 1}), options, {}),
                   expected);
}

TEST_CASE("periodic faces and distant nodes that are tied leave the modes of the null space") {
  testing::BlockMesh box = testing::box({1, 1, 2}, {0.2, 0.3, 0.5}, kSteel);
  mesher::Mesh mesh = box.make();
  const std::vector<std::int32_t> lower = mesh.node_set("bottom").nodes;
  const std::vector<std::int32_t> upper = mesh.node_set("top").nodes;
  const auto tie = [&](std::int32_t one, std::int32_t other) {
    for (std::size_t a = 0; a < 3; ++a) {
      mesher::Equation equation{"tie", {{one, {}}, {other, {}}}};
      equation.terms[0].coefficients[a] = 1;
      equation.terms[1].coefficients[a] = -1;
      mesh.connections.equations.push_back(equation);
    }
  };
  SECTION("periodic: it slides, and turns about the line between the faces") {
    for (std::size_t k = 0; k < lower.size(); ++k) tie(upper[k], lower[k]);
    check_against_null_space(mesh, 4);
  }
  SECTION("the other way about") {
    for (std::size_t k = 0; k < lower.size(); ++k) tie(lower[k], upper[k]);
    check_against_null_space(mesh, 4);
  }
  SECTION("one pair") {
    tie(upper[0], lower[0]);
    check_against_null_space(mesh, 4);
  }
  SECTION("two pairs on oblique lines, and a support") {
    tie(upper[0], lower[8]);
    tie(upper[2], lower[7]);
    mesh.connections.supports = {{"plane", lower, {false, false, true}}};
    check_against_null_space(mesh, 2);
  }
}

TEST_CASE("equations count by their directions, not by the size of their coefficients") {
  mesher::Mesh mesh = testing::box({1, 1, 2}, {0.2, 0.3, 0.5}, kSteel).make();
  mesh.connections.equations = {{"a", {{20, {1, 0, 0}}, {3, {0, 1e6, 0}}}},
                                {"b", {{30, {1e-3, 0, 0}}, {5, {0, 0, 1e3}}}},
                                {"c", {{41, {0, 1e6, 0}}, {9, {0, 0, 1}}}}};
  check_against_null_space(mesh, 3);
}

TEST_CASE("modes of a block on soft springs, 1e-8 of its own, are found together with these") {
  mesher::Mesh mesh = testing::box({1, 1, 1}, {0.1, 0.12, 0.05}, kSteel).make();
  for (const std::int32_t node : {0, 2, 6, 8}) {
    for (std::size_t a = 0; a < 3; ++a) {
      mesher::Spring spring{"mount", {{node, {}}}, 100};
      spring.terms[0].coefficients[a] = 1;
      mesh.connections.springs.push_back(spring);
    }
  }
  const DenseConstraints model = dense_model(mesh);
  const Eigen::VectorXd lowest = testing::lowest_values(model.stiffness, model.mass, 8);
  ModalOptions options = eight_modes();
  const ModalBody body = analyse_modes(mesh, options, {});
  const Eigen::VectorXd values = (2 * std::numbers::pi * body.frequencies_Hz.array()).square();
  CAPTURE(values.transpose(), lowest.transpose());
  CHECK((values.head(6) - lowest.head(6)).cwiseAbs().maxCoeff() < 1e-5 * lowest[0]);
  // The expected values are the block's own, by dense matrices without springs; the soft springs
  // hardly change them.
  const Eigen::VectorXd own = testing::dense_pairs(model.stiffness, model.mass).values;
  for (Eigen::Index k = 6; k < 8; ++k) CHECK(values[k] == Approx(own[k]).epsilon(1e-6));
}

}  // namespace flexneck::fe_modal
