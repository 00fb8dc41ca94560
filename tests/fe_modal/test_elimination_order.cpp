// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "fe_modal/algebra/cholesky_factor.h"
#include "fe_modal/system/assembly.h"
#include "fe_modal/system/elimination_order.h"
#include "mesher/partition/node_order.h"
#include "tests/support/block_mesh.h"
#include "tests/support/element_choices.h"

namespace flexneck::fe_modal {
namespace {

/// Displacements of all nodes under a force in one direction on the node at a corner.
Eigen::Matrix3Xd bent(const DofMap& dof_map, const CholeskyFactor& factor) {
  Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Zero(3, dof_map.node_count());
  forces.rightCols<1>() = Eigen::Vector3d(3, 1, 2);
  return dof_map.expand(factor.solve(dof_map.gather(forces)));
}

}  // namespace

TEST_CASE("a body numbered as its factor eliminates it has that factor and moves as ever") {
  const mesher::Mesh mesh = testing::box({3, 3, 8}, {0.1, 0.1, 0.3}, kSteel).make();
  ModalOptions options;
  options.fixed_set = "bottom";
  const DofMap by_sites = dof_map_of(mesh, options);
  const DofMap numbered = numbered_dof_map_of(mesh, options);
  REQUIRE(numbered.is_renumbered());
  const SystemMatrices other = assemble(mesh, by_sites);
  const auto order = mesher::nested_dissection(other.graph.offsets(), other.graph.columns());
  const CholeskyFactor expected(other.stiffness.get(), 0, order);
  const SystemMatrices system = assemble(mesh, numbered);
  const CholeskyFactor factor(system.stiffness.get(), 0, CholmodOrder::numbering, {});
  CHECK(factor.nonzeros() == expected.nonzeros());
  const Eigen::Matrix3Xd motion = bent(by_sites, expected);
  CHECK((bent(numbered, factor) - motion).norm() < 1e-9 * motion.norm());
}

TEST_CASE("a body keeps the order of its nodes where the factor is not one process's") {
  const mesher::Mesh mesh = testing::box({2, 2, 3}, {0.1, 0.1, 0.3}, kSteel).make();
  ModalOptions options;
  options.fixed_set = "bottom";
  options.solver = Solver::iterative;
  CHECK_FALSE(numbered_dof_map_of(mesh, options).is_renumbered());
  options.solver = Solver::direct;
  options.fixed_directions["top"] = {true, false, false};
  CHECK_FALSE(numbered_dof_map_of(mesh, options).is_renumbered());
}

}  // namespace flexneck::fe_modal
