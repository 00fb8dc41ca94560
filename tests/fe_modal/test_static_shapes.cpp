// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdlib>

#include <Eigen/Cholesky>
#include <catch2/catch.hpp>

#include "fe_modal/reduction/static_shapes.h"
#include "tests/support/dense_solvers.h"

namespace flexneck::fe_modal {
namespace {

constexpr Eigen::Index kSize = 40;
constexpr Eigen::Index kModes = 5;

Eigen::MatrixXd definite(double diagonal) {
  const Eigen::MatrixXd root = Eigen::MatrixXd::Random(kSize, kSize);
  return root * root.transpose() + diagonal * Eigen::MatrixXd::Identity(kSize, kSize);
}

}  // namespace

TEST_CASE("a compliance is wrong by squares of what its modes are wrong by") {
  std::srand(1);  // gives the same matrices in any order of tests
  const Eigen::MatrixXd stiffness = definite(1);
  const Eigen::MatrixXd mass = definite(20);
  const Eigen::LLT<Eigen::MatrixXd> factor(stiffness);
  const BodyOperators body{
      [&](const Eigen::MatrixXd& x) -> Eigen::MatrixXd { return stiffness * x; },
      [&](const Eigen::MatrixXd& x) -> Eigen::MatrixXd { return mass * x; },
      [&](const Eigen::MatrixXd& f) -> Eigen::MatrixXd { return factor.solve(f); }};
  const Eigen::MatrixXd forces = Eigen::MatrixXd::Random(kSize, 6);
  const Eigen::MatrixXd exact = forces.transpose() * factor.solve(forces);
  const auto all = testing::dense_pairs(stiffness, mass);
  const Eigen::MatrixXd others =
      all.vectors.rightCols(kSize - kModes) * Eigen::MatrixXd::Random(kSize - kModes, kModes);
  const auto error_with = [&](double wrong) {
    // Inexact modes by Rayleigh-Ritz: M-orthonormal, and K between them is diagonal.
    const Eigen::MatrixXd span = all.vectors.leftCols(kModes) + wrong * others;
    const auto ritz =
        testing::dense_pairs(span.transpose() * stiffness * span, span.transpose() * mass * span);
    const EigenPairs kept{ritz.values, span * ritz.vectors};
    const StaticShapes shapes = static_shapes(body, kept, {{"tip", forces}});
    return (shapes.responses.front().compliance - exact).norm() / exact.norm();
  };
  CHECK(error_with(0) < 1e-10);
  const double larger = error_with(1e-3);
  CHECK(larger < 1e-4);
  CHECK(error_with(1e-4) == Approx(larger / 100).epsilon(0.1));
}

}  // namespace flexneck::fe_modal
