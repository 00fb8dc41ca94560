// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "fe_modal/solve/linear_solver.h"
#include "fe_modal/system/assembly.h"
#include "fe_modal/system/elimination_order.h"
#include "tests/fe_modal/dense.h"
#include "tests/support/block_mesh.h"
#include "tests/support/dense_solvers.h"
#include "tests/support/element_choices.h"

namespace flexneck::fe_modal {

TEST_CASE("CHOLMOD and MUMPS solve as a dense matrix does, whatever order the rows have") {
  const mesher::Mesh mesh = testing::box({2, 2, 3}, {0.1, 0.1, 0.3}, kSteel).make();
  for (const bool is_renumbered : {false, true}) {
    DofMap dof_map(mesh, mesh.node_set("bottom").nodes);
    if (is_renumbered) dof_map.renumber(elimination_order_of(mesh, dof_map, {}));
    const SystemMatrices system = assemble(mesh, dof_map);
    const Eigen::MatrixXd stiffness = dense(system.stiffness.get());
    const Eigen::MatrixXd forces = Eigen::MatrixXd::Random(stiffness.rows(), 3);
    const Eigen::MatrixXd expected = testing::symmetric_solution(stiffness, forces);
    for (const Solver solver : {Solver::automatic, Solver::cholmod, Solver::mumps}) {
      const LinearSolver inverse(system.stiffness.get(), 0, {}, solver);
      CHECK((inverse.solve(forces) - expected).norm() < 1e-9 * expected.norm());
      CHECK_THAT(inverse.describe(), Catch::StartsWith(solver == Solver::mumps ? "MUMPS: the factor"
                                                                               : "CHOLMOD: the "));
    }
  }
}

TEST_CASE("nested dissection of nodes leaves fewer entries than the numbering of the mesh") {
  const mesher::Mesh mesh = testing::box({3, 3, 8}, {0.1, 0.1, 0.3}, kSteel).make();
  DofMap dof_map(mesh, mesh.node_set("bottom").nodes);
  const auto entries = [&] {
    return LinearSolver(assemble(mesh, dof_map).stiffness.get(), 0).nonzeros();
  };
  std::vector<std::int32_t> scattered;  // every third node first
  for (std::int32_t start = 0; start < 3; ++start)
    for (std::int32_t k = start; k < dof_map.free_count(); k += 3) scattered.push_back(k);
  DofMap bad = dof_map;
  bad.renumber(scattered);
  const double in_bad_order = LinearSolver(assemble(mesh, bad).stiffness.get(), 0).nonzeros();
  dof_map.renumber(elimination_order_of(mesh, dof_map, {}));
  CHECK(entries() * 1.3 < in_bad_order);
}

TEST_CASE("a matrix that is not positive definite is told from one that cannot be solved") {
  const mesher::Mesh mesh = testing::box({1, 1, 2}, {0.1, 0.1, 0.4}, kSteel).make();
  const SystemMatrices system = assemble(mesh, DofMap(mesh, mesh.node_set("bottom").nodes));
  const double above_all = 1e15;
  const MatHandle shifted = shifted_stiffness(system.stiffness.get(), system.mass.get(), above_all);
  for (const Solver solver : {Solver::cholmod, Solver::mumps})
    CHECK_THROWS_AS(LinearSolver(shifted.get(), above_all, {}, solver), NotDefinite);
}

}  // namespace flexneck::fe_modal
