// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/fit/identifiability.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/SVD>

#include "geometry/foundation/symmetric_pairs.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Inverse of an information matrix; a parameter with a component along a direction without
/// information has an infinite variance.
MatrixXd inverse_of(const MatrixXd& information) {
  constexpr double kNothing = 1e-12;  // fraction of the largest eigenvalue
  constexpr double kPart = 1e-6;
  const auto [values, vectors] = symmetric_pairs(information);
  const double largest = values.cwiseAbs().maxCoeff();
  MatrixXd inverse = MatrixXd::Zero(information.rows(), information.cols());
  std::vector<bool> is_open(static_cast<std::size_t>(information.rows()), false);
  for (Index k = 0; k < information.rows(); ++k) {
    const VectorXd vector = vectors.col(k);
    if (values[k] > kNothing * largest) {
      inverse += vector * vector.transpose() / values[k];
      continue;
    }
    for (Index i = 0; i < vector.size(); ++i)
      if (std::abs(vector[i]) > kPart) is_open[static_cast<std::size_t>(i)] = true;
  }
  for (Index i = 0; i < inverse.rows(); ++i)
    if (is_open[static_cast<std::size_t>(i)]) inverse(i, i) = kInfinite;
  return inverse;
}

MatrixXd correlations_of(const MatrixXd& covariance) {
  const VectorXd deviations = covariance.diagonal().cwiseSqrt();
  MatrixXd found = covariance.cwiseQuotient(deviations * deviations.transpose());
  for (Index i = 0; i < found.rows(); ++i) {
    if (std::isfinite(deviations[i])) continue;
    found.row(i).setConstant(std::nan(""));
    found.col(i).setConstant(std::nan(""));
  }
  found.diagonal().setOnes();
  return found;
}

}  // namespace

double Identifiability::deviation(Index parameter) const {
  return std::sqrt(covariance(parameter, parameter));
}

Identifiability identifiability(const FitObjective& objective, const MatrixXd& jacobian) {
  const Index count = objective.parameter_count();
  const auto fitted = static_cast<Index>(objective.fitted().size());
  Identifiability found;
  MatrixXd of_targets = MatrixXd::Zero(std::max(fitted, count), count);
  of_targets.topRows(fitted) = jacobian.topRows(fitted);
  const Eigen::JacobiSVD<MatrixXd> svd(of_targets, Eigen::ComputeThinV);
  found.singular_values = svd.singularValues();
  found.directions = svd.matrixV();
  const MatrixXd information = jacobian.transpose() * jacobian;
  found.covariance = inverse_of(information);
  found.correlations = correlations_of(found.covariance);

  std::vector<MatrixXd> shares;  // parts of the information, one per target
  for (Index row = 0; row < fitted; ++row) {
    const std::string& target =
        objective.terms()[objective.fitted()[static_cast<std::size_t>(row)]].target;
    if (found.targets.empty() || found.targets.back() != target) {
      found.targets.push_back(target);
      shares.push_back(MatrixXd::Zero(count, count));
    }
    shares.back() += jacobian.row(row).transpose() * jacobian.row(row);
  }
  found.widening.resize(static_cast<Index>(shares.size()), count);
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const VectorXd without = inverse_of(information - shares[k]).diagonal();
    for (Index i = 0; i < count; ++i)
      found.widening(static_cast<Index>(k), i) =
          std::isinf(found.covariance(i, i)) ? 1 : std::sqrt(without[i] / found.covariance(i, i));
  }
  return found;
}

std::vector<Index> parameters_along(const VectorXd& direction) {
  const VectorXd parts = direction.cwiseAbs();
  std::vector<Index> order(static_cast<std::size_t>(parts.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return parts[a] > parts[b]; });
  std::erase_if(order, [&](Index k) { return parts[k] < 0.5 * parts.maxCoeff(); });
  return order;
}

double chi_squared_quantile(double probability, double degrees_of_freedom) {
  return boost::math::quantile(boost::math::chi_squared(degrees_of_freedom), probability);
}

}  // namespace flexneck::pipeline
