// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "fe_modal/exchange/corner_fields.h"
#include "mesher/mesh/positions.h"
#include "tests/support/block_mesh.h"
#include "tests/support/element_choices.h"
#include "tests/support/element_meshes.h"

namespace flexneck::fe_modal {
namespace {

constexpr double kRounding = 1e-12;

mesher::Mesh block_of(mesher::ElementKind kind) {
  return testing::with_kind(testing::box({2, 2, 2}, {0.2, 0.3, 0.4}, kSteel).make(), kind);
}

}  // namespace

TEST_CASE("point masses at the corners are positive, with mass and centre of the body") {
  for (const mesher::ElementKind kind : kVolumes) {
    INFO(mesher::name_of(kind));
    const mesher::Mesh mesh = block_of(kind);
    const CornerMasses corners = lump_at_corners(mesh);
    const Eigen::Matrix3Xd positions = positions_of(mesh);
    CHECK(corners.nodes.size() == 27);  // corners of 2 x 2 x 2 hexahedra, cut or not
    CHECK(corners.masses_kg.minCoeff() > 0);
    const double mass = 7850 * 0.2 * 0.3 * 0.4;
    CHECK(corners.masses_kg.sum() == Approx(mass).epsilon(kRounding));
    const Eigen::Vector3d centre =
        positions(Eigen::all, corners.nodes) * corners.masses_kg / corners.masses_kg.sum();
    const Eigen::Vector3d all_centre =
        0.5 * (positions.rowwise().minCoeff() + positions.rowwise().maxCoeff());
    CHECK((centre - all_centre).norm() < kRounding);
  }
}

TEST_CASE("corners turn with a rigid rotation, and by half its shear angle with a shear") {
  const Eigen::Vector3d turn(0.3, -0.2, 0.5);
  for (const mesher::ElementKind kind : kVolumes) {
    INFO(mesher::name_of(kind));
    const mesher::Mesh mesh = block_of(kind);
    const CornerMasses corners = lump_at_corners(mesh);
    Eigen::Matrix3Xd motion = positions_of(mesh);
    for (auto point : motion.colwise()) {
      const double height = point.z();
      point = turn.cross(Eigen::Vector3d(point)).eval();
      point.x() += 0.1 * height;  // rotates by 0.05 about y
    }
    const Eigen::Vector3d expected = turn + Eigen::Vector3d(0, 0.05, 0);
    const Eigen::Matrix3Xd rotations = corner_rotations(mesh, corners.nodes, motion);
    CHECK((rotations.colwise() - expected).cwiseAbs().maxCoeff() < kRounding);
  }
}

TEST_CASE("where plate and rubber meet, corners turn as the plate does") {
  // The plate does not move, the rubber is sheared: alone it would rotate by half the shear angle.
  testing::BlockMesh block = testing::box({1, 1, 2}, {0.1, 0.1, 0.1}, kSteel);
  block.slices = {{"plate", 1, kSteel}, {"rubber", 1, kRubber}};
  const mesher::Mesh mesh = block.make();
  const CornerMasses corners = lump_at_corners(mesh);
  const Eigen::Matrix3Xd positions = positions_of(mesh);
  const double face = 0.5 * (positions.row(2).minCoeff() + positions.row(2).maxCoeff());
  Eigen::Matrix3Xd motion = Eigen::Matrix3Xd::Zero(3, positions.cols());
  motion.row(0) = (positions.row(2).array() - face).cwiseMax(0);
  const Eigen::Matrix3Xd rotations = corner_rotations(mesh, corners.nodes, motion);
  for (std::size_t k = 0; k < corners.nodes.size(); ++k) {
    const double height = positions(2, corners.nodes[k]) - face;
    const double expected = height > 1e-6 ? 0.5 : 0;
    // The moduli's ratio is 25 000.
    CHECK(std::abs(rotations(1, static_cast<Eigen::Index>(k)) - expected) < 1e-4);
  }
}

}  // namespace flexneck::fe_modal
