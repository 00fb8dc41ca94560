// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <functional>
#include <new>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "fe_modal/algebra/cholesky_factor.h"
#include "fe_modal/algebra/operator_matrix.h"
#include "fe_modal/solve/eigensolver.h"
#include "fe_modal/solve/iterative/block_davidson.h"
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
  // A square bar of 2 x 2 x 3 elements: bending comes in pairs.
  constexpr double kTolerance = 1e-9;
  const mesher::Mesh mesh = testing::box({2, 2, 3}, {0.1, 0.1, 0.4}, kSteel).make();
  const DofMap dof_map(mesh, mesh.node_set("bottom").nodes);
  const SystemMatrices system = assemble(mesh, dof_map);
  const CholeskyFactor factor(system.stiffness.get(), 0);
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
  const CholeskyFactor factor(shifted_stiffness(system, shift).get(), shift);
  const EigenPairs pairs = lowest_eigenpairs(system.mass.get(), factor, 9);
  const Eigen::VectorXd expected = dense_eigenvalues(system);
  CHECK(pairs.values.head(6).cwiseAbs().maxCoeff() < 1e-9 * expected[6]);
  CHECK(((pairs.values.tail(3) - expected.segment<3>(6)).array() / expected.segment<3>(6).array())
            .abs()
            .maxCoeff() < 1e-9);
}

TEST_CASE("whatever an operator throws comes out of the solver as it was, and the next run works") {
  class Failing : public ShiftInverse {
   public:
    explicit Failing(std::function<void()> fail) : ShiftInverse(0), fail_(std::move(fail)) {}
    Eigen::MatrixXd solve(const Eigen::MatrixXd& sides) const override {
      fail_();
      return sides;
    }
    std::string describe() const override { return "failing"; }

   private:
    std::function<void()> fail_;
  };
  const MatHandle unit = diagonal_matrix(Eigen::VectorXd::Ones(20));
  const auto solve_with = [&](std::function<void()> fail) {
    lowest_eigenpairs(unit.get(), Failing(std::move(fail)), 2);
  };
  CHECK_THROWS_AS(solve_with([] { throw std::bad_alloc(); }), std::bad_alloc);
  CHECK_THROWS_WITH(solve_with([] { throw ComputationError("no convergence"); }), "no convergence");
  CHECK_THROWS_AS(solve_with([] { throw 1; }), int);

  // Of the mass, which is an operator too.
  const OperatorMatrix mass(
      20, [](const Eigen::MatrixXd&) -> Eigen::MatrixXd { throw std::bad_alloc(); });
  const CholeskyFactor factor(unit.get(), 0);
  CHECK_THROWS_AS(lowest_eigenpairs(mass.get(), factor, 2), std::bad_alloc);
  CHECK(lowest_eigenpairs(unit.get(), factor, 2).values[1] == Approx(1));
}

TEST_CASE("PETSc's want of memory is told as such, with the step, the amount and a way out") {
  CHECK_THROWS_AS(require(PETSC_ERR_MEM, "filling a matrix"), OutOfMemory);
  CHECK_THROWS_WITH(require(PETSC_ERR_MEM, "filling a matrix"),
                    Catch::StartsWith("memory runs out while filling a matrix: ") &&
                        Catch::Contains(" GB are free; take a coarser mesh"));
  CHECK_THROWS_WITH(require(PETSC_ERR_ARG_SIZ, "filling a matrix"),
                    Catch::Contains("PETSc failed while filling a matrix"));
}

TEST_CASE("all copies of manifold eigenvalues are found") {
  Eigen::VectorXd diagonal(60);
  for (Eigen::Index k = 0; k < diagonal.size(); ++k) diagonal[k] = 100.0 + 7.0 * double(k);
  diagonal.head(9) << 1, 1, 1, 1, 1, 2, 2, 2, 3;
  const MatHandle stiffness = diagonal_matrix(diagonal);
  const MatHandle mass = diagonal_matrix(Eigen::VectorXd::Ones(60));
  const CholeskyFactor factor(stiffness.get(), 0);
  for (const Eigen::Index count : {3, 5, 7, 8, 9}) {
    const EigenPairs pairs = lowest_eigenpairs(mass.get(), factor, count);
    CHECK((pairs.values - diagonal.head(count)).cwiseAbs().maxCoeff() < 1e-9);
    CHECK((pairs.vectors.transpose() * pairs.vectors - Eigen::MatrixXd::Identity(count, count))
              .cwiseAbs()
              .maxCoeff() < 1e-9);
  }
}

TEST_CASE("a Davidson block of dependent columns settles as many modes as it has, not more") {
  const Eigen::VectorXd diagonal = Eigen::VectorXd::LinSpaced(30, 1, 30);
  const MatHandle mass = diagonal_matrix(Eigen::VectorXd::Ones(30));
  const auto stiffness = [&](const Eigen::MatrixXd& x) -> Eigen::MatrixXd {
    return diagonal.asDiagonal() * x;
  };
  const auto of_two = [&](const Eigen::MatrixXd& x) {
    Eigen::MatrixXd y = diagonal.cwiseInverse().asDiagonal() * x;
    y.bottomRows(28).setZero();
    return y;
  };
  const auto found = [&](Eigen::Index count) {
    return block_davidson({}, stiffness, mass.get(), of_two, count, {1e-15, 20});
  };
  const auto two = found(2);
  REQUIRE(two);
  CHECK((two->pairs.values - diagonal.head(2)).cwiseAbs().maxCoeff() < 1e-14);
  CHECK_FALSE(found(3));
}

TEST_CASE("a Davidson basis that spans all that moves with mass takes no rounding in") {
  // As of a small body under many constraints, by a factor in single precision.
  constexpr Eigen::Index kSize = 30;
  const auto massive = GENERATE(range(Eigen::Index{5}, Eigen::Index{11}));
  const Eigen::Index count = massive - GENERATE(0, 1, 2);
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(kSize);
  masses.head(massive).setOnes();
  const MatHandle mass = diagonal_matrix(masses);
  const Eigen::VectorXd coupled = Eigen::VectorXd::LinSpaced(kSize, 1, 7).array().cos();
  Eigen::MatrixXd stiffness = coupled * coupled.transpose();
  stiffness.diagonal().array() +=
      Eigen::VectorXd::LinSpaced(kSize, 1, kSize).array().pow(GENERATE(2, 4));
  const Eigen::LLT<Eigen::MatrixXf> factor(stiffness.cast<float>());
  const auto nearly = [&](const Eigen::MatrixXd& x) -> Eigen::MatrixXd {
    const Eigen::VectorXd lengths = x.colwise().norm().cwiseMax(1e-300).transpose();
    const Eigen::MatrixXf unit = (x * lengths.cwiseInverse().asDiagonal()).cast<float>();
    return factor.solve(unit).cast<double>() * lengths.asDiagonal();
  };
  const auto found =
      block_davidson({}, [&](const Eigen::MatrixXd& x) -> Eigen::MatrixXd { return stiffness * x; },
                     mass.get(), nearly, count, {1e-18, 20});
  if (!found) return;  // then a factor in double goes on
  const Eigen::MatrixXd compliance = stiffness.inverse().topLeftCorner(massive, massive);
  const Eigen::VectorXd expected =
      testing::symmetric_eigenvalues(compliance).reverse().head(count).cwiseInverse();
  CHECK((found->pairs.values.array() / expected.array() - 1).abs().maxCoeff() < 1e-9);
}

TEST_CASE("every mode of a small system can be asked for") {
  const Eigen::VectorXd diagonal = Eigen::VectorXd::LinSpaced(9, 1, 9);
  const MatHandle stiffness = diagonal_matrix(diagonal);
  const MatHandle mass = diagonal_matrix(Eigen::VectorXd::Constant(9, 4));
  const CholeskyFactor factor(stiffness.get(), 0);
  const EigenPairs pairs = lowest_eigenpairs(mass.get(), factor, 9);
  CHECK((pairs.values - diagonal / 4).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("a stiffness that is not positive definite is refused") {
  const mesher::Mesh mesh = testing::box({1, 1, 2}, {0.1, 0.1, 0.4}, kSteel).make();
  const DofMap dof_map(mesh, mesh.node_set("bottom").nodes);
  const SystemMatrices system = assemble(mesh, dof_map);
  const double above_the_first = 2 * dense_eigenvalues(system)[0];
  CHECK_THROWS_WITH(
      CholeskyFactor(shifted_stiffness(system, above_the_first).get(), above_the_first),
      Catch::Contains("not positive definite"));
}

}  // namespace flexneck::fe_modal
