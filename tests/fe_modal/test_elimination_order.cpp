// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "fe_modal/solve/linear_solver.h"
#include "fe_modal/system/assembly.h"
#include "fe_modal/system/elimination_order.h"
#include "tests/support/block_mesh.h"
#include "tests/support/element_choices.h"

namespace flexneck::fe_modal {
namespace {

/// Displacements of all nodes under a force in one direction on the node at a corner.
Eigen::Matrix3Xd bent(const DofMap& dof_map, const LinearSolver& factor) {
  Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Zero(3, dof_map.node_count());
  forces.rightCols<1>() = Eigen::Vector3d(3, 1, 2);
  return dof_map.expand(factor.solve(dof_map.gather(forces)));
}

}  // namespace

TEST_CASE("a body moves as ever however its blocks are numbered, with constraints too") {
  const mesher::Mesh mesh = testing::box({3, 3, 8}, {0.1, 0.1, 0.3}, kSteel).make();
  ModalOptions options;
  options.fixed_set = "bottom";
  for (const bool is_constrained : {false, true}) {
    if (is_constrained) {
      options.fixed_directions["top"] = {true, false, false};
      options.interfaces = {{"tip", "top", {0.05, 0.05, 0.3}, true}};
    }
    const DofMap by_sites = dof_map_of(mesh, options);
    const Model model(mesh, options);
    const LinearSolver expected(assemble(mesh, by_sites).stiffness.get(), 0);
    const LinearSolver factor(assemble(model).stiffness.get(), 0);
    const Eigen::Matrix3Xd motion = bent(by_sites, expected);
    CHECK((bent(model.dof_map(), factor) - motion).norm() < 1e-9 * motion.norm());
    // The free values of such a field are also the same.
    const Eigen::VectorXd values = model.dof_map().restrict(motion);
    CHECK((model.dof_map().expand(values) - motion).norm() < 1e-9 * motion.norm());
  }
}

}  // namespace flexneck::fe_modal
