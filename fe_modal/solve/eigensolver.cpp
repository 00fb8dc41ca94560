// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/eigensolver.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "fe_modal/algebra/block_product.h"
#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/algebra/random_block.h"
#include "fe_modal/solve/block_lanczos.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

/// Residuals relative to the eigenvalue theta = 1 / (lambda - shift). The error of an eigenvector
/// is this over the relative gap to its neighbour: 1e-10 for frequencies 1 % apart.
constexpr double kResidual = 1e-12;
/// After so many blocks rounding is taken to hide the last digits of the residuals, as it does of
/// elastic modes on soft mounts and where equations with large coefficients chain: ten times as
/// much is allowed with every ten blocks more. Eigenvalues are exact to the square of residuals.
constexpr int kBlocksInFull = 40;
constexpr double kBlocksOfTenfold = 10;
constexpr double kMaxResidual = 1e-5;
/// The first pair that is not wanted is settled to the square of this: enough to tell that it is
/// not one that was missed.
constexpr double kResidualOfNext = 1e-2;
constexpr Eigen::Index kColumns = 8;  ///< a free body has six equal eigenvalues
constexpr std::uint64_t kSeed = 1;

}  // namespace

EigenPairs lowest_eigenpairs(Mat mass, const ShiftInverse& inverse, Eigen::Index count) {
  if (std::optional<EigenPairs> own = inverse.iterate(mass, count)) return *std::move(own);
  int blocks = 0;  // that had all pairs
  const Settled settled = [&](const RitzState& state) {
    const Eigen::VectorXd& residuals = state.residuals;
    const int late = std::max(++blocks - kBlocksInFull, 0);
    const double allowed =
        std::min(kResidual * std::pow(10, late / kBlocksOfTenfold), kMaxResidual);
    return residuals.head(count).maxCoeff() < allowed &&
           (residuals.size() == count || residuals[count] < kResidualOfNext);
  };
  const Eigen::Index size = size_of(mass);
  const EigenPairs all =
      block_lanczos(mass, inverse, random_block(mass, std::min(kColumns, size), kSeed),
                    std::min(count + 1, size), settled);
  if (all.values.size() < count) {
    throw ComputationError("the eigensolver found " + std::to_string(all.values.size()) + " of " +
                           std::to_string(count) + " modes");
  }
  EigenPairs found{all.values.head(count), all.vectors.leftCols(count)};
  if (all.values.size() > count) found.next = all.values[count];
  return purified(mass, inverse, found);
}

Eigen::VectorXd relative_residuals(Mat stiffness, Mat mass, const ShiftInverse& inverse,
                                   const EigenPairs& pairs) {
  const auto norms = [&](const Eigen::MatrixXd& columns) -> Eigen::VectorXd {
    return column_products(inverse.ranks(), columns, columns).cwiseSqrt();
  };
  const Eigen::MatrixXd forces = block_product(stiffness, pairs.vectors);
  const Eigen::MatrixXd momenta = block_product(mass, pairs.vectors);
  const Eigen::VectorXd scales =
      (pairs.values.array() == 0).select(std::abs(inverse.shift()) * norms(momenta), norms(forces));
  return norms(forces - momenta * pairs.values.asDiagonal()).cwiseQuotient(scales);
}

}  // namespace flexneck::fe_modal
