// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/sweep/correlation.h"

#include <algorithm>
#include <vector>

#include <Eigen/Cholesky>

#include "geometry/foundation/error.h"
#include "pipeline/parameter_studies/sampling/distribution.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Correlation::Correlation(const SweepSection& sweep) : is_none_(sweep.correlations.empty()) {
  const auto count = static_cast<Index>(sweep.parameters.size());
  matrix_ = MatrixXd::Identity(count, count);
  for (const SweepCorrelation& each : sweep.correlations) {
    const auto i = static_cast<Index>(each.parameters[0]);
    const auto j = static_cast<Index>(each.parameters[1]);
    matrix_(i, j) = matrix_(j, i) = each.coefficient;
  }
  const Eigen::LLT<MatrixXd> cholesky(matrix_);
  constexpr double kLeastPivot = 1e-6;
  factor_ = cholesky.matrixL();
  if (cholesky.info() != Eigen::Success || !(factor_.diagonal().minCoeff() > kLeastPivot))
    throw InputError(
        "sweep.correlation: expected consistent coefficients, found a correlation matrix that is "
        "not positive definite; reduce them");
}

VectorXd probabilities(const VectorXd& scores) {
  constexpr double kLeast = 0x1p-53;  // further out Phi rounds to 0 or 1
  return scores.unaryExpr(&normal_cdf).cwiseMax(kLeast).cwiseMin(1 - kLeast);
}

VectorXd Correlation::correlated(const VectorXd& independent) const {
  if (is_none_) return independent;
  return probabilities(factor_ * independent.unaryExpr(&normal_quantile));
}

VectorXd Correlation::redrawn(const VectorXd& scores, const std::vector<Index>& free,
                              const VectorXd& normal) const {
  std::vector<Index> given;
  for (Index k = 0; k < scores.size(); ++k)
    if (std::find(free.begin(), free.end(), k) == free.end()) given.push_back(k);
  // Mean and covariance of a part of a normal vector, given the rest of it.
  const MatrixXd across = matrix_(free, given);
  MatrixXd covariance = matrix_(free, free);
  VectorXd part = VectorXd::Zero(static_cast<Index>(free.size()));
  if (!given.empty()) {
    const Eigen::LLT<MatrixXd> known(MatrixXd(matrix_(given, given)));
    part = across * known.solve(VectorXd(scores(given)));
    covariance -= across * known.solve(across.transpose());
  }
  const Eigen::LLT<MatrixXd> cholesky(covariance);
  part += cholesky.matrixL() * VectorXd(normal(free));
  VectorXd result = scores;
  result(free) = part;
  return result;
}

}  // namespace flexneck::pipeline
