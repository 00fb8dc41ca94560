// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <sys/resource.h>
#include <unistd.h>
#include <vector>

#include <catch2/catch.hpp>

#include "fe_modal/algebra/petsc_choices.h"
#include "fe_modal/solve/linear_solver.h"
#include "fe_modal/system/assembly.h"
#include "fe_modal/system/elimination_order.h"
#include "geometry/foundation/available_memory.h"
#include "tests/fe_modal/dense.h"
#include "tests/support/block_mesh.h"
#include "tests/support/dense_solvers.h"
#include "tests/support/element_choices.h"

namespace flexneck::fe_modal {
namespace {

/// Limits the memory that the process may take in addition while it lives.
class AddressLimit {
 public:
  explicit AddressLimit(double more_bytes) {
    std::ifstream statm("/proc/self/statm");
    double pages = 0;
    statm >> pages;
    getrlimit(RLIMIT_AS, &before_);
    rlimit limit = before_;
    limit.rlim_cur =
        static_cast<rlim_t>(pages * static_cast<double>(sysconf(_SC_PAGESIZE)) + more_bytes);
    setrlimit(RLIMIT_AS, &limit);
  }
  ~AddressLimit() { setrlimit(RLIMIT_AS, &before_); }
  AddressLimit(const AddressLimit&) = delete;
  AddressLimit& operator=(const AddressLimit&) = delete;

 private:
  rlimit before_{};
};

}  // namespace

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

TEST_CASE("a factor that memory does not hold is refused by its symbolic part, with a way out") {
  const mesher::Mesh mesh = testing::box({6, 6, 8}, {0.1, 0.1, 0.3}, kSteel).make();
  DofMap dof_map(mesh, mesh.node_set("bottom").nodes);
  dof_map.renumber(elimination_order_of(mesh, dof_map, {}));
  const SystemMatrices system = assemble(mesh, dof_map);
  const double entries = LinearSolver(system.stiffness.get(), 0).nonzeros();
  for (const Solver solver : {Solver::cholmod, Solver::mumps}) {
    const AddressLimit limit(0.9 * sizeof(double) * entries);
    CHECK_THROWS_WITH(LinearSolver(system.stiffness.get(), 0, {}, solver),
                      Catch::StartsWith("factorising the stiffness matrix needs about ") &&
                          Catch::Contains("out of core"));
  }
  CHECK_NOTHROW(LinearSolver(system.stiffness.get(), 0));
}

TEST_CASE("a factor of more entries than CHOLMOD can count is refused by its symbolic part") {
  // A star: the elimination of its centre, the first row, couples all others.
  constexpr PetscInt kRows = 70'000;
  std::vector<PetscInt> entries_of_row(kRows, 1);
  entries_of_row[0] = kRows;
  MatHandle star;
  REQUIRE(MatCreateSeqSBAIJ(PETSC_COMM_SELF, 1, kRows, kRows, 0, entries_of_row.data(),
                            star.out()) == 0);
  for (PetscInt k = 0; k < kRows; ++k) {
    REQUIRE(MatSetValue(star.get(), k, k, 2 * kRows, INSERT_VALUES) == 0);
    if (k > 0) REQUIRE(MatSetValue(star.get(), 0, k, -1, INSERT_VALUES) == 0);
  }
  REQUIRE(MatAssemblyBegin(star.get(), MAT_FINAL_ASSEMBLY) == 0);
  REQUIRE(MatAssemblyEnd(star.get(), MAT_FINAL_ASSEMBLY) == 0);
  REQUIRE(MatSetOption(star.get(), MAT_SPD, PETSC_TRUE) == 0);
  CHECK_THROWS_WITH(LinearSolver(star.get(), 0, {}, Solver::cholmod),
                    Catch::Contains("2147483647") && Catch::Contains("use the solver mumps"));
}

TEST_CASE("a limit of MUMPS's memory that does not hold the factor is told as such") {
  const mesher::Mesh mesh = testing::box({4, 4, 4}, {0.1, 0.1, 0.3}, kSteel).make();
  const SystemMatrices system = assemble(mesh, DofMap(mesh, mesh.node_set("bottom").nodes));
  const PetscChoices choices("-st_mat_mumps_icntl_23 1");  // MB
  CHECK_THROWS_AS(LinearSolver(system.stiffness.get(), 0, {}, Solver::mumps), OutOfMemory);
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
