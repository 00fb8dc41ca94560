// SPDX-License-Identifier: GPL-3.0-or-later
#include <functional>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "fe_modal/system/rigid_average.h"
#include "tests/support/block_mesh.h"
#include "tests/support/element_choices.h"

namespace flexneck::fe_modal {
namespace {

constexpr double kRounding = 1e-12;

Eigen::Matrix3Xd sample(const mesher::Mesh& mesh,
                        const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& field) {
  Eigen::Matrix3Xd values(3, static_cast<Eigen::Index>(mesh.nodes.size()));
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k) {
    values.col(static_cast<Eigen::Index>(k)) =
        field(Eigen::Map<const Eigen::Vector3d>(mesh.nodes[k].data()));
  }
  return values;
}

Vector6d motion(const Eigen::Vector3d& translation, const Eigen::Vector3d& rotation) {
  Vector6d result;
  result << translation, rotation;
  return result;
}

}  // namespace

TEST_CASE("a rigid motion is its own average, on curved faces and in distorted elements") {
  testing::BlockMesh block = testing::box({2, 3, 2}, {1, 1, 1}, kSteel);
  block.position = testing::distorted;
  const mesher::Mesh mesh = block.make();
  const RigidAverage face(mesh, mesh.face_set("top"), {0.3, -0.2, 1.5});
  const RigidAverage part(mesh, "block");
  const Eigen::Vector3d translation(0.3, -0.7, 0.2);
  const Eigen::Vector3d rotation(-0.4, 0.1, 0.9);
  for (const RigidAverage* average : {&face, &part}) {
    const Eigen::Matrix3Xd field = sample(mesh, [&](const Eigen::Vector3d& x) -> Eigen::Vector3d {
      return translation + rotation.cross(x - average->point_m());
    });
    CHECK((average->of(field) - motion(translation, rotation)).norm() < kRounding);
  }
}

TEST_CASE("the average of a homogeneous strain on a flat face is the slope of the face") {
  // The field is u = S x on the plane z = 0 about the centre of a rectangle: translation zero; u_z
  // = S_zx x + S_zy y tilts the plane by (S_zy, -S_zx); the in-plane shear rotates it by int (x u_y
  // - y u_x) / int (x^2 + y^2) = S_xy (a^2 - b^2) / (a^2 + b^2), zero for a square.
  Eigen::Matrix3d strain;
  strain << 0.3, 0.5, -0.2, 0.5, -0.1, 0.7, -0.2, 0.7, 0.4;
  for (const double side_y : {0.2, 0.1}) {
    constexpr double kSideX = 0.2;
    const mesher::Mesh mesh = testing::box({3, 2, 1}, {kSideX, side_y, 0.3}, kSteel).make();
    const RigidAverage face(mesh, mesh.face_set("bottom"), Eigen::Vector3d::Zero());
    const double a2 = kSideX * kSideX;
    const double b2 = side_y * side_y;
    const Vector6d expected =
        motion({0, 0, 0}, {strain(2, 1), -strain(2, 0), strain(0, 1) * (a2 - b2) / (a2 + b2)});
    const Vector6d found = face.of(
        sample(mesh, [&](const Eigen::Vector3d& x) -> Eigen::Vector3d { return strain * x; }));
    CHECK((found - expected).norm() < kRounding);
  }
}

TEST_CASE("weights reproduce the average as a sum over nodes") {
  const mesher::Mesh mesh = testing::box({2, 1, 2}, {0.2, 0.1, 0.3}, kSteel).make();
  const RigidAverage face(mesh, mesh.face_set("top"), {0, 0, 0.3});
  const auto n = static_cast<Eigen::Index>(mesh.nodes.size());
  const auto weights = face.weights(n);
  const Eigen::Matrix3Xd field = Eigen::Matrix3Xd::Random(3, n);
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(weights[i].cwiseProduct(field).sum() ==
          Approx(face.of(field)[static_cast<Eigen::Index>(i)]).epsilon(1e-12));
  }
}

TEST_CASE("the Gram matrix of a part is its rigid mass matrix") {
  const Eigen::Vector3d size(0.2, 0.1, 0.3);
  const mesher::Mesh mesh = testing::box({2, 1, 2}, size, kSteel).make();
  const RigidAverage part(mesh, "block");
  CHECK((part.point_m() - Eigen::Vector3d(0, 0, 0.15)).norm() < kRounding);
  const double mass = kSteel.density_kg_m3 * size.prod();
  const Eigen::Vector3d squares = size.array().square();
  Vector6d expected;
  expected << mass, mass, mass, mass / 12 * (squares[1] + squares[2]),
      mass / 12 * (squares[2] + squares[0]), mass / 12 * (squares[0] + squares[1]);
  CHECK((part.gram() - Matrix6d(expected.asDiagonal())).norm() < kRounding * mass);
}

}  // namespace flexneck::fe_modal
