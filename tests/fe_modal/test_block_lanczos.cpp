// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "fe_modal/block_lanczos.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

/// The pencil K = diag(lambda m), M = diag(m): K^-1 M has the eigenvalues 1 / lambda and, as
/// eigenvectors, unit vectors over sqrt(m).
struct DiagonalPencil {
  Eigen::VectorXd values;
  Eigen::VectorXd mass;

  explicit DiagonalPencil(const Eigen::VectorXd& lambda)
      : values(lambda), mass(Eigen::VectorXd::LinSpaced(lambda.size(), 0.5, 3)) {}

  RitzPairs solve(Eigen::Index count) const {
    const Eigen::VectorXd stiffness = values.cwiseProduct(mass);
    return largest_eigenpairs(
        [&](const Eigen::MatrixXd& f) -> Eigen::MatrixXd {
          return stiffness.cwiseInverse().asDiagonal() * f;
        },
        [&](const Eigen::MatrixXd& x) -> Eigen::MatrixXd { return mass.asDiagonal() * x; },
        values.size(), count);
  }
};

void check_pairs(const DiagonalPencil& pencil, Eigen::Index count, double tolerance) {
  const RitzPairs pairs = pencil.solve(count);
  const Eigen::VectorXd lambda = pairs.values.cwiseInverse();
  CHECK((lambda - pencil.values.head(count)).cwiseAbs().maxCoeff() <
        tolerance * pencil.values[count - 1]);
  const Eigen::MatrixXd modal_mass =
      pairs.vectors.transpose() * pencil.mass.asDiagonal() * pairs.vectors;
  CHECK((modal_mass - Eigen::MatrixXd::Identity(count, count)).cwiseAbs().maxCoeff() < 1e-12);
}

}  // namespace

TEST_CASE("more copies of an eigenvalue are found than a block has vectors") {
  for (const Eigen::Index copies : {7, 8, 9, 20}) {
    CAPTURE(copies);
    Eigen::VectorXd lambda = Eigen::VectorXd::LinSpaced(200, 5, 500);
    lambda.head(copies + 1).setConstant(2);
    lambda[0] = 1;
    check_pairs(DiagonalPencil(lambda), copies + 3, 1e-11);
  }
}

TEST_CASE("crowded eigenvalues are reached by restarts") {
  // Gaps of 0.1 % on 3000 values: far more steps than the basis has room for.
  check_pairs(DiagonalPencil(Eigen::VectorXd::LinSpaced(3000, 1, 4)), 10, 1e-11);
}

TEST_CASE("a search may exhaust the space") {
  for (const Eigen::Index count : {1, 5, 13}) {
    check_pairs(DiagonalPencil(Eigen::VectorXd::LinSpaced(13, 1, 9)), count, 1e-12);
  }
  check_pairs(DiagonalPencil(Eigen::VectorXd::Constant(5, 3)), 5, 1e-12);
  check_pairs(DiagonalPencil(Eigen::VectorXd::Constant(30, 3)), 4, 1e-12);
}

TEST_CASE("a space with few different eigenvalues is gone through block by block") {
  // The Krylov space of any block ends after two steps.
  Eigen::VectorXd lambda = Eigen::VectorXd::Constant(60, 2);
  lambda.head(3).setConstant(1);
  check_pairs(DiagonalPencil(lambda), 25, 1e-12);
}

}  // namespace flexneck::fe_modal
