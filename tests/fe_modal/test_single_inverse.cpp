// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include <catch2/catch.hpp>

#include "fe_modal/algebra/cholesky_factor.h"
#include "fe_modal/solve/eigensolver.h"
#include "fe_modal/solve/iterative/single_inverse.h"
#include "fe_modal/system/assembly.h"
#include "tests/fe_modal/dense.h"
#include "tests/support/block_mesh.h"
#include "tests/support/dense_solvers.h"

namespace flexneck::fe_modal {
namespace {

/// A bar whose bending is soft beside its elements.
SystemMatrices slender_bar() {
  const mesher::Mesh mesh =
      testing::box({1, 1, 12}, {0.04, 0.05, 0.5}, {"steel", 2.1e11, 0.3, 7850}).make();
  return assemble(mesh, DofMap(mesh, mesh.node_set("bottom").nodes));
}

Matrices products_of(const SystemMatrices& system) {
  return {system.stiffness.get(), system.mass.get()};
}

SingleInverse::InDouble factor_of(const SystemMatrices& system) {
  return [&system] { return std::make_unique<CholeskyFactor>(system.stiffness.get(), 0); };
}

double difference(const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected) {
  return (found - expected).norm() / expected.norm();
}

void check_as_dense(const ShiftInverse& inverse, const SystemMatrices& system) {
  constexpr double kSame = 1e-9;
  constexpr Eigen::Index kModes = 5;
  const Eigen::MatrixXd stiffness = dense(system.stiffness.get());
  const Eigen::MatrixXd loads = Eigen::MatrixXd::Random(stiffness.rows(), 11);
  const Eigen::MatrixXd expected = testing::symmetric_solution(stiffness, loads);
  CHECK(difference(inverse.solve(loads), expected) < kSame);
  CHECK(difference(inverse.improve(loads, (1 + 1e-8) * expected), expected) < kSame);
  const EigenPairs pairs = lowest_eigenpairs(system.mass.get(), inverse, kModes);
  const Eigen::MatrixXd mass = dense(system.mass.get());
  const auto modes = testing::dense_pairs(stiffness, mass);
  CHECK(difference(pairs.values.cwiseQuotient(modes.values.head(kModes)),
                   Eigen::VectorXd::Ones(kModes)) < kSame);
  const Eigen::MatrixXd shares = pairs.vectors.transpose() * mass * modes.vectors.leftCols(kModes);
  CHECK(difference(shares.cwiseAbs(), Eigen::MatrixXd::Identity(kModes, kModes)) < kSame);
}

}  // namespace

TEST_CASE("solutions and modes by a factor in single precision are those of dense matrices") {
  const SystemMatrices system = slender_bar();
  const auto inverse = make_shift_inverse(system.stiffness.get(), products_of(system), 0,
                                          CholmodOrder::best, {}, 1, factor_of(system));
  check_as_dense(*inverse, system);
  CHECK_THAT(inverse->describe(), Catch::Contains("4 bytes each"));
  const Eigen::VectorXd load = Eigen::VectorXd::Random(system.stiffness.size());
  const Eigen::VectorXd exact = inverse->solve(load);
  const double rough = difference(inverse->approximate(load), exact);
  CHECK(rough < 0.1);
  CHECK(rough > 1e-9);
}

TEST_CASE("where iterations with a factor do not settle, one in double takes over") {
  const SystemMatrices system = slender_bar();
  const auto by_nothing = [&] {
    return SingleInverse({[](const Eigen::MatrixXd& x) { return x; }, "no factor"},
                         products_of(system), 0, factor_of(system));
  };
  check_as_dense(by_nothing(), system);  // solutions are asked for first
  const SingleInverse inverse = by_nothing();
  const Eigen::VectorXd expected =
      testing::dense_pairs(dense(system.stiffness.get()), dense(system.mass.get())).values.head(3);
  const Eigen::VectorXd found = lowest_eigenpairs(system.mass.get(), inverse, 3).values;
  CHECK(difference(found.cwiseQuotient(expected), Eigen::VectorXd::Ones(3)) < 1e-9);
  CHECK_THAT(inverse.describe(), !Catch::Contains("4 bytes each"));
}

TEST_CASE("a matrix with a negative eigenvalue is left to a factor in double, which refuses it") {
  const SystemMatrices system = slender_bar();
  const Eigen::MatrixXd stiffness = dense(system.stiffness.get());
  const double first =
      testing::dense_pairs(stiffness, dense(system.mass.get())).values.head(1).value();
  const CholeskyFactor near(system.stiffness.get(), 0);  // positive definite, and nearly right
  const double shift = 1.001 * first;
  const SingleInverse inverse({[&](const Eigen::MatrixXd& x) { return near.solve(x); }, "factor"},
                              products_of(system), shift, [&] {
                                return std::make_unique<CholeskyFactor>(
                                    shifted_stiffness(system, shift).get(), shift);
                              });
  CHECK_THROWS_WITH(lowest_eigenpairs(system.mass.get(), inverse, 3),
                    Catch::Contains("not positive definite"));
}

}  // namespace flexneck::fe_modal
