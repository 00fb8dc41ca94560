// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <catch2/catch.hpp>

#include "fe_modal/algebra/conjugate_gradients.h"

namespace flexneck::fe_modal {
namespace {

/// Eigenvalues from 1 to 1000.
Eigen::MatrixXd positive_matrix(Eigen::Index size) {
  const Eigen::MatrixXd basis = Eigen::MatrixXd::Random(size, size).householderQr().householderQ();
  const Eigen::VectorXd values =
      Eigen::VectorXd::LinSpaced(size, 0, 3).unaryExpr([](double exponent) {
        return std::pow(10, exponent);
      });
  return basis * values.asDiagonal() * basis.transpose();
}

/// Four columns of which the third is the sum of the first two and the last is zero.
Eigen::MatrixXd dependent_columns(Eigen::Index size) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Random(size, 4);
  columns.col(2) = columns.col(0) + columns.col(1);
  columns.col(3).setZero();
  return columns;
}

}  // namespace

TEST_CASE("conjugate gradients solve for dependent columns and for none at all as Cholesky does") {
  constexpr Eigen::Index kSize = 80;
  const Eigen::MatrixXd matrix = positive_matrix(kSize);
  const Eigen::VectorXd diagonal = matrix.diagonal();
  const Eigen::MatrixXd loads = dependent_columns(kSize);
  const auto multiply_by = [&](const Eigen::MatrixXd& x) -> Eigen::MatrixXd { return matrix * x; };
  const auto divide = [&](const Eigen::MatrixXd& r) -> Eigen::MatrixXd {
    return diagonal.cwiseInverse().asDiagonal() * r;
  };
  const Eigen::MatrixXd exact = matrix.llt().solve(loads);
  const Eigen::MatrixXd found = conjugate_gradients({}, multiply_by, divide, loads);
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Eigen::VectorXd error = found.col(k) - exact.col(k);
    CHECK(error.dot(matrix * error) < 1e-18 * exact.col(k).dot(loads.col(k)));
  }
  CHECK(found.col(3).isZero(0));
  CHECK(conjugate_gradients({}, multiply_by, divide, Eigen::MatrixXd::Zero(kSize, 2)).isZero(0));
}

TEST_CASE("conjugate gradients with the inverse itself take it twice, to solve and to know") {
  const Eigen::MatrixXd matrix = positive_matrix(30);
  const Eigen::LLT<Eigen::MatrixXd> factor(matrix);
  const Eigen::MatrixXd loads = dependent_columns(30);
  int solves = 0;
  const Eigen::MatrixXd found = conjugate_gradients(
      {}, [&](const Eigen::MatrixXd& x) -> Eigen::MatrixXd { return matrix * x; },
      [&](const Eigen::MatrixXd& r) -> Eigen::MatrixXd {
        ++solves;
        return factor.solve(r);
      },
      loads);
  CHECK(solves == 2);
  CHECK(found.isApprox(factor.solve(loads), 1e-12));
}

TEST_CASE("conjugate gradients end sooner where most of the energy is known before") {
  const Eigen::MatrixXd matrix = positive_matrix(80);
  const Eigen::MatrixXd load = Eigen::VectorXd::Random(80);
  const auto steps = [&](const Eigen::VectorXd& known_energies) {
    int count = 0;
    conjugate_gradients(
        {},
        [&](const Eigen::MatrixXd& x) -> Eigen::MatrixXd {
          ++count;
          return matrix * x;
        },
        [](const Eigen::MatrixXd& r) { return r; }, load, known_energies);
    return count;
  };
  CHECK(steps(Eigen::VectorXd::Constant(1, 1e12 * load.squaredNorm())) < steps({}));
}

}  // namespace flexneck::fe_modal
