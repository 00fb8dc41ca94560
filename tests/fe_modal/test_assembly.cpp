// SPDX-License-Identifier: GPL-3.0-or-later
#include <span>
#include <vector>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "fe_modal/system/assembly.h"
#include "tests/fe_modal/dense.h"
#include "tests/support/block_mesh.h"

namespace flexneck::fe_modal {
namespace {

mesher::Mesh bent_sandwich() {
  testing::BlockMesh block = testing::box({2, 1, 2}, {1, 1, 1}, {});
  block.slices = {{"plate", 1, {"steel", 2.1e11, 0.3, 7850}},
                  {"pad", 1, {"rubber", 8.3e6, 0.49, 950}}};
  block.position = [](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return 0.1 * testing::distorted(p);
  };
  return block.make();
}

}  // namespace

TEST_CASE("assembled matrices are symmetric, and a free body resists no rigid motion") {
  constexpr double kRounding = 1e-12;
  const mesher::Mesh mesh = bent_sandwich();
  const DofMap all(mesh, {});
  const SystemMatrices system = assemble(mesh, all);
  const Eigen::MatrixXd stiffness = dense(system.stiffness.get());
  const Eigen::MatrixXd mass = dense(system.mass.get());
  CHECK((stiffness - stiffness.transpose()).norm() < kRounding * stiffness.norm());
  CHECK((mass - mass.transpose()).norm() < kRounding * mass.norm());

  Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(stiffness.rows(), 6);
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(3 * k);
    const auto& x = mesh.nodes[k];
    rigid.block<3, 3>(row, 0).setIdentity();
    rigid.block<3, 3>(row, 3) << 0, x[2], -x[1], -x[2], 0, x[0], x[1], -x[0], 0;
  }
  CHECK((stiffness * rigid).norm() < kRounding * stiffness.norm() * rigid.norm());
}

TEST_CASE("holding nodes takes their rows and columns out and leaves the others as they were") {
  const mesher::Mesh mesh = bent_sandwich();
  const std::vector<std::int32_t> fixed = {0, 3, 17, 40};
  const SystemMatrices free_system = assemble(mesh, DofMap(mesh, {}));
  const DofMap dof_map(mesh, fixed);
  const SystemMatrices fixed_system = assemble(mesh, dof_map);
  std::vector<Eigen::Index> kept;
  for (std::int32_t node = 0; node < static_cast<std::int32_t>(mesh.nodes.size()); ++node) {
    if (dof_map.index(node) < 0) continue;
    for (int a = 0; a < 3; ++a) kept.push_back(3 * node + a);
  }
  REQUIRE(static_cast<Eigen::Index>(kept.size()) == dof_map.dof_count());
  CHECK(dof_map.dof_count() == static_cast<Eigen::Index>(3 * (mesh.nodes.size() - 4)));
  CHECK(dense(fixed_system.stiffness.get()) == dense(free_system.stiffness.get())(kept, kept));
  CHECK(dense(fixed_system.mass.get()) == dense(free_system.mass.get())(kept, kept));
}

TEST_CASE("the mass acts alike in each direction and equals the nodal mass") {
  const mesher::Mesh mesh = bent_sandwich();
  const SystemMatrices system = assemble(mesh, DofMap(mesh, {}));
  const Eigen::MatrixXd mass = dense(system.mass.get());
  const Eigen::MatrixXd nodal(system.nodal_mass);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(mass.rows(), mass.cols());
  for (Eigen::Index i = 0; i < nodal.rows(); ++i) {
    for (Eigen::Index j = 0; j < nodal.cols(); ++j) {
      expected.block<3, 3>(3 * i, 3 * j).diagonal().setConstant(nodal(i, j));
    }
  }
  CHECK(mass.isApprox(expected, 1e-15));
}

TEST_CASE("a shift takes the mass off the stiffness") {
  const mesher::Mesh mesh = bent_sandwich();
  const SystemMatrices system = assemble(mesh, DofMap(mesh, mesh.node_set("bottom").nodes));
  constexpr double kShift = -3e5;
  const Eigen::MatrixXd expected =
      dense(system.stiffness.get()) - kShift * dense(system.mass.get());
  CHECK(
      (dense(shifted_stiffness(system.stiffness.get(), system.mass.get(), kShift).get()) - expected)
          .norm() < 1e-15 * expected.norm());
}

TEST_CASE("a field comes back from its free values, and forces do the same work on them") {
  const std::vector<std::int32_t> fixed = {1, 4};
  // Nodes 2 and 5 are tied, and so are 0, 6 and 7, where two cuts cross.
  std::vector<mesher::Slit> slits(2);
  slits[0].tied = true;
  slits[0].lower = {2, 7};
  slits[0].upper = {5, 6};
  slits[1].tied = true;
  slits[1].lower = {6};
  slits[1].upper = {0};
  const DofMap dof_map(9, fixed, slits);
  REQUIRE(dof_map.free_count() == 4);  // blocks {0, 6, 7}, {2, 5}, 3, 8
  const Eigen::VectorXd values = Eigen::VectorXd::Random(12);
  const Eigen::Matrix3Xd field = dof_map.expand(values);
  CHECK(field.col(1).isZero());
  CHECK(field.col(4).isZero());
  CHECK(field.col(2) == field.col(5));
  CHECK(field.col(0) == field.col(6));
  CHECK(field.col(0) == field.col(7));
  CHECK(field.col(8) == values.tail<3>());
  const Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Random(3, 9);
  CHECK(dof_map.gather(forces).dot(values) ==
        Approx(forces.cwiseProduct(field).sum()).epsilon(1e-14));
}

TEST_CASE("a node tied to a fixed one is fixed, an open slit ties nothing") {
  const std::vector<std::int32_t> fixed = {3};
  mesher::Slit slit;
  slit.lower = {0};
  slit.upper = {3};
  CHECK(DofMap(4, fixed, std::span(&slit, 1)).free_count() == 3);
  slit.tied = true;
  const DofMap dof_map(4, fixed, std::span(&slit, 1));
  CHECK(dof_map.free_count() == 2);
  CHECK(dof_map.index(0) == -1);
}

}  // namespace flexneck::fe_modal
