// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <functional>
#include <new>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "fe_modal/algebra/operator_matrix.h"
#include "fe_modal/solve/eigensolver.h"
#include "fe_modal/solve/linear_solver.h"
#include "fe_modal/system/assembly.h"
#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"
#include "tests/fe_modal/dense.h"
#include "tests/support/block_mesh.h"
#include "tests/support/dense_solvers.h"
#include "tests/support/element_choices.h"

namespace flexneck::fe_modal {
namespace {

MatHandle diagonal_matrix(const Eigen::VectorXd& diagonal) {
  MatHandle matrix;
  const auto size = static_cast<PetscInt>(diagonal.size());
  require(MatCreateSeqSBAIJ(PETSC_COMM_SELF, 1, size, size, 1, nullptr, matrix.out()), "making");
  for (PetscInt k = 0; k < size; ++k) {
    require(MatSetValue(matrix.get(), k, k, diagonal[k], INSERT_VALUES), "filling");
  }
  require(MatAssemblyBegin(matrix.get(), MAT_FINAL_ASSEMBLY), "assembling");
  require(MatAssemblyEnd(matrix.get(), MAT_FINAL_ASSEMBLY), "assembling");
  require(MatSetOption(matrix.get(), MAT_SPD, PETSC_TRUE), "labelling");
  return matrix;
}

Eigen::VectorXd dense_eigenvalues(const SystemMatrices& system) {
  return testing::dense_pairs(dense(system.stiffness.get()), dense(system.mass.get())).values;
}

}  // namespace

TEST_CASE("modes of a fixed body agree with a dense solution, exactly double ones included") {
  // The bar is square, of 2 x 2 x 3 elements: bending modes come in pairs.
  constexpr double kTolerance = 1e-9;
  const mesher::Mesh mesh = testing::box({2, 2, 3}, {0.1, 0.1, 0.4}, kSteel).make();
  const DofMap dof_map(mesh, mesh.node_set("bottom").nodes);
  const SystemMatrices system = assemble(mesh, dof_map);
  const LinearSolver factor(system.stiffness.get(), 0);
  const EigenPairs pairs = lowest_eigenpairs(system.mass.get(), factor, 12);
  const Eigen::VectorXd expected = dense_eigenvalues(system).head(12);
  REQUIRE(std::abs(expected[1] / expected[0] - 1) < 1e-8);
  CHECK(((pairs.values - expected).array() / expected.array()).abs().maxCoeff() < kTolerance);

  const Eigen::MatrixXd mass = dense(system.mass.get());
  const Eigen::MatrixXd modal_mass = pairs.vectors.transpose() * mass * pairs.vectors;
  CHECK((modal_mass - Eigen::MatrixXd::Identity(12, 12)).cwiseAbs().maxCoeff() < 1e-12);
  const Eigen::VectorXd residuals =
      relative_residuals(system.stiffness.get(), system.mass.get(), factor, pairs);
  CHECK(residuals.maxCoeff() < 1e-8);
}

TEST_CASE("a free body has six eigenvalues of zero and the elastic ones of a dense solution") {
  const mesher::Mesh mesh = testing::box({2, 1, 3}, {0.15, 0.1, 0.4}, kSteel).make();
  const DofMap dof_map(mesh, {});
  const SystemMatrices system = assemble(mesh, dof_map);
  const double shift = -1e7;
  const LinearSolver factor(
      shifted_stiffness(system.stiffness.get(), system.mass.get(), shift).get(), shift);
  const EigenPairs pairs = lowest_eigenpairs(system.mass.get(), factor, 9);
  const Eigen::VectorXd expected = dense_eigenvalues(system);
  CHECK(pairs.values.head(6).cwiseAbs().maxCoeff() < 1e-9 * expected[6]);
  CHECK(((pairs.values.tail(3) - expected.segment<3>(6)).array() / expected.segment<3>(6).array())
            .abs()
            .maxCoeff() < 1e-9);
}

TEST_CASE("what an operator throws comes out of the solver as it was, and the next run works") {
  const MatHandle unit = diagonal_matrix(Eigen::VectorXd::Ones(20));
  const OperatorMatrix mass(
      20, [](const Eigen::MatrixXd&) -> Eigen::MatrixXd { throw std::bad_alloc(); });
  const LinearSolver factor(unit.get(), 0);
  CHECK_THROWS_AS(lowest_eigenpairs(mass.get(), factor, 2), std::bad_alloc);
  CHECK(lowest_eigenpairs(unit.get(), factor, 2).values[1] == Approx(1));
}

TEST_CASE("PETSc's want of memory is told as such, with the step, the amount and a way out") {
  CHECK_THROWS_AS(require(PETSC_ERR_MEM, "filling a matrix"), OutOfMemory);
  CHECK_THROWS_WITH(require(PETSC_ERR_MEM, "filling a matrix"),
                    Catch::StartsWith("out of memory while filling a matrix: ") &&
                        Catch::Contains(" GB are free; use a coarser mesh"));
  CHECK_THROWS_WITH(require(PETSC_ERR_ARG_SIZ, "filling a matrix"),
                    Catch::Contains("PETSc failed while filling a matrix"));
}

TEST_CASE("all copies of manifold eigenvalues are found") {
  Eigen::VectorXd diagonal(60);
  for (Eigen::Index k = 0; k < diagonal.size(); ++k) diagonal[k] = 100.0 + 7.0 * double(k);
  diagonal.head(9) << 1, 1, 1, 1, 1, 2, 2, 2, 3;
  const MatHandle stiffness = diagonal_matrix(diagonal);
  const MatHandle mass = diagonal_matrix(Eigen::VectorXd::Ones(60));
  const LinearSolver factor(stiffness.get(), 0);
  for (const Eigen::Index count : {3, 5, 7, 8, 9}) {
    const EigenPairs pairs = lowest_eigenpairs(mass.get(), factor, count);
    CHECK((pairs.values - diagonal.head(count)).cwiseAbs().maxCoeff() < 1e-9);
    CHECK((pairs.vectors.transpose() * pairs.vectors - Eigen::MatrixXd::Identity(count, count))
              .cwiseAbs()
              .maxCoeff() < 1e-9);
  }
}

TEST_CASE("known eigenvectors are not found again, and what is above the last is told") {
  const Eigen::VectorXd diagonal = Eigen::VectorXd::LinSpaced(40, 1, 40);
  const MatHandle stiffness = diagonal_matrix(diagonal);
  const MatHandle mass = diagonal_matrix(Eigen::VectorXd::Ones(40));
  const LinearSolver factor(stiffness.get(), 0);
  const Eigen::MatrixXd known = Eigen::MatrixXd::Identity(40, 3);
  const EigenPairs pairs = lowest_eigenpairs(mass.get(), factor, 4, known);
  CHECK((pairs.values - Eigen::Vector4d(4, 5, 6, 7)).cwiseAbs().maxCoeff() < 1e-9);
  CHECK(pairs.next == Approx(8).epsilon(1e-3));
  CHECK((known.transpose() * pairs.vectors).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("every mode of a small system can be asked for") {
  const Eigen::VectorXd diagonal = Eigen::VectorXd::LinSpaced(9, 1, 9);
  const MatHandle stiffness = diagonal_matrix(diagonal);
  const MatHandle mass = diagonal_matrix(Eigen::VectorXd::Constant(9, 4));
  const LinearSolver factor(stiffness.get(), 0);
  const EigenPairs pairs = lowest_eigenpairs(mass.get(), factor, 9);
  CHECK((pairs.values - diagonal / 4).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("a stiffness that is not positive definite is refused") {
  const mesher::Mesh mesh = testing::box({1, 1, 2}, {0.1, 0.1, 0.4}, kSteel).make();
  const DofMap dof_map(mesh, mesh.node_set("bottom").nodes);
  const SystemMatrices system = assemble(mesh, dof_map);
  const double above_the_first = 2 * dense_eigenvalues(system)[0];
  CHECK_THROWS_WITH(
      LinearSolver(
          shifted_stiffness(system.stiffness.get(), system.mass.get(), above_the_first).get(),
          above_the_first),
      Catch::Contains("not positive definite"));
}

}  // namespace flexneck::fe_modal
