// SPDX-License-Identifier: GPL-3.0-or-later
#include <vector>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "fe_modal/assembly.h"
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
  const FreeNodes all(mesh.nodes.size(), {});
  const SystemMatrices system = assemble(mesh, all);
  const Eigen::MatrixXd stiffness = dense(system.stiffness.get());
  const Eigen::MatrixXd mass = dense(system.mass.get());
  CHECK((stiffness - stiffness.transpose()).norm() < kRounding * stiffness.norm());
  CHECK((mass - mass.transpose()).norm() == 0);

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
  const std::vector<std::int32_t> held = {0, 3, 17, 40};
  const SystemMatrices free_system = assemble(mesh, FreeNodes(mesh.nodes.size(), {}));
  const FreeNodes free_nodes(mesh.nodes.size(), held);
  const SystemMatrices held_system = assemble(mesh, free_nodes);
  std::vector<Eigen::Index> kept;
  for (std::int32_t node = 0; node < static_cast<std::int32_t>(mesh.nodes.size()); ++node) {
    if (free_nodes.index(node) < 0) continue;
    for (int a = 0; a < 3; ++a) kept.push_back(3 * node + a);
  }
  REQUIRE(static_cast<Eigen::Index>(kept.size()) == free_nodes.dof_count());
  CHECK(free_nodes.dof_count() == static_cast<Eigen::Index>(3 * (mesh.nodes.size() - 4)));
  CHECK(dense(held_system.stiffness.get()) == dense(free_system.stiffness.get())(kept, kept));
  CHECK(dense(held_system.mass.get()) == dense(free_system.mass.get())(kept, kept));
}

TEST_CASE("the mass acts alike in each direction and equals the nodal mass") {
  const mesher::Mesh mesh = bent_sandwich();
  const SystemMatrices system = assemble(mesh, FreeNodes(mesh.nodes.size(), {}));
  const Eigen::MatrixXd mass = dense(system.mass.get());
  const Eigen::MatrixXd nodal(system.nodal_mass);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(mass.rows(), mass.cols());
  for (Eigen::Index i = 0; i < nodal.rows(); ++i) {
    for (Eigen::Index j = 0; j < nodal.cols(); ++j) {
      expected.block<3, 3>(3 * i, 3 * j).diagonal().setConstant(nodal(i, j));
    }
  }
  CHECK(mass == expected);
}

TEST_CASE("room is made for exactly the entries that come") {
  const mesher::Mesh mesh = bent_sandwich();
  const SystemMatrices system =
      assemble(mesh, FreeNodes(mesh.nodes.size(), mesh.node_set("bottom").nodes));
  for (const MatHandle* matrix : {&system.stiffness, &system.mass}) {
    MatInfo info;
    REQUIRE(MatGetInfo(matrix->get(), MAT_LOCAL, &info) == 0);
    CHECK(info.nz_unneeded == 0);
    CHECK(info.mallocs == 0);
  }
}

TEST_CASE("a field keeps its values through restriction to the free nodes and back") {
  const std::vector<std::int32_t> held = {1, 4};
  const FreeNodes free_nodes(6, held);
  Eigen::Matrix3Xd field = Eigen::Matrix3Xd::Random(3, 6);
  field(Eigen::all, {1, 4}).setZero();
  CHECK(free_nodes.expand(free_nodes.restrict(field)) == field);
}

}  // namespace flexneck::fe_modal
