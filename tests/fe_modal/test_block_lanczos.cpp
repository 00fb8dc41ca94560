// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <utility>

#include <catch2/catch.hpp>

#include "fe_modal/solve/block_lanczos.h"
#include "tests/support/dense_solvers.h"

namespace flexneck::fe_modal {
namespace {

/// K^-1 of a diagonal K.
class DiagonalInverse : public ShiftInverse {
 public:
  explicit DiagonalInverse(Eigen::VectorXd stiffness)
      : ShiftInverse(0), stiffness_(std::move(stiffness)) {}

  Eigen::MatrixXd solve(const Eigen::MatrixXd& loads) const override {
    return stiffness_.cwiseInverse().asDiagonal() * loads;
  }
  std::string describe() const override { return "diagonal"; }

 private:
  Eigen::VectorXd stiffness_;
};

MatHandle dense_matrix(Eigen::MatrixXd& entries) {
  MatHandle matrix;
  const auto size = static_cast<PetscInt>(entries.rows());
  require(MatCreateSeqDense(PETSC_COMM_SELF, size, size, entries.data(), matrix.out()), "wrapping");
  return matrix;
}

}  // namespace

TEST_CASE("block Lanczos keeps its answer when little but rounding is left of a block") {
  // As when a mass is added to a body whose modes are known: the modes and the responses to the
  // forces of the mass span nearly all of what comes next.
  constexpr Eigen::Index kSize = 400;
  Eigen::VectorXd stiffness(kSize);
  Eigen::MatrixXd loads(kSize, 6);
  for (Eigen::Index i = 0; i < kSize; ++i) {
    stiffness[i] = std::pow(static_cast<double>(i + 1), 3);
    for (Eigen::Index k = 0; k < 6; ++k) loads(i, k) = std::cos(static_cast<double>((k + 1) * i));
  }
  Eigen::MatrixXd mass = Eigen::MatrixXd::Identity(kSize, kSize) + loads * loads.transpose();
  const MatHandle mass_matrix = dense_matrix(mass);
  const DiagonalInverse inverse(stiffness);
  Eigen::MatrixXd start(kSize, 16);
  start << Eigen::MatrixXd::Identity(kSize, 10), inverse.solve(loads);
  int blocks = 0;
  // It would do to stop after three.
  const Settled settled = [&](const RitzState& /*state*/) { return ++blocks == 25; };
  const EigenPairs found = block_lanczos(mass_matrix.get(), inverse, start, 6, settled);
  const Eigen::VectorXd expected =
      testing::dense_pairs(Eigen::MatrixXd(stiffness.asDiagonal()), mass).values.head(6);
  // The dense solution loses the ratio of the largest stiffness to these: six digits and a half.
  CHECK((found.values.array() / expected.array() - 1).abs().maxCoeff() < 1e-8);
}

TEST_CASE("block Lanczos ends where its basis spans all that moves with mass") {
  // As of a small body under many constraints, whose dependent degrees of freedom have none.
  constexpr Eigen::Index kSize = 75;
  const auto massive = GENERATE(Eigen::Index{60}, Eigen::Index{61}, Eigen::Index{62});
  Eigen::VectorXd stiffness = Eigen::VectorXd::Ones(kSize);
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(kSize, 6);
  Eigen::MatrixXd start(kSize, 8);
  for (Eigen::Index i = 0; i < kSize; ++i) {
    const auto number = static_cast<double>(i + 1);
    for (Eigen::Index k = 0; k < 8; ++k)
      start(i, k) = std::cos(static_cast<double>(k + 1) * number * number);
    if (i >= massive) continue;
    stiffness[i] = std::pow(number, 4);
    for (Eigen::Index k = 0; k < 6; ++k)
      loads(i, k) = std::cos(static_cast<double>(k + 1) * number);
  }
  Eigen::MatrixXd mass = loads * loads.transpose();
  mass.diagonal().head(massive).array() += 1;
  const MatHandle mass_matrix = dense_matrix(mass);
  const Settled never = [](const RitzState& /*state*/) { return false; };
  const EigenPairs found =
      block_lanczos(mass_matrix.get(), DiagonalInverse(stiffness), start, 9, never);
  const Eigen::VectorXd expected =
      testing::dense_pairs(Eigen::MatrixXd(stiffness.head(massive).asDiagonal()),
                           Eigen::MatrixXd(mass.topLeftCorner(massive, massive)))
          .values.head(9);
  CHECK((found.values.array() / expected.array() - 1).abs().maxCoeff() < 1e-8);
}

}  // namespace flexneck::fe_modal
