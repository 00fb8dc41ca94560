// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/sampling/distribution.h"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace flexneck::pipeline {

namespace {

/// Policy that returns errors as NaN or infinity: a probability is never 0 or 1 here.
using NoThrow = boost::math::policies::policy<
    boost::math::policies::domain_error<boost::math::policies::ignore_error>,
    boost::math::policies::overflow_error<boost::math::policies::ignore_error>>;

/// Quantile of a truncated normal distribution, at Phi(low) + p (Phi(high) - Phi(low)), computed in
/// the tail in which the differences keep their digits.
double cut_normal_quantile(const SweepDistribution& normal, double probability) {
  const double low = (normal.low - normal.mean) / normal.standard_deviation;
  const double high = (normal.high - normal.mean) / normal.standard_deviation;
  const bool is_upper = low > 0;
  const double from = is_upper ? normal_cdf(-low) : normal_cdf(low);
  const double to = is_upper ? normal_cdf(-high) : normal_cdf(high);
  const double z = normal_quantile((1 - probability) * from + probability * to);
  const double value = normal.mean + normal.standard_deviation * (is_upper ? -z : z);
  return std::clamp(value, normal.low, normal.high);
}

double triangular_quantile(const SweepDistribution& triangle, double probability) {
  const double width = triangle.high - triangle.low;
  const double rise = triangle.mode - triangle.low;
  const double fall = triangle.high - triangle.mode;
  return probability * width < rise ? triangle.low + std::sqrt(probability * width * rise)
                                    : triangle.high - std::sqrt((1 - probability) * width * fall);
}

double lognormal_quantile(const SweepDistribution& lognormal, double probability) {
  const double ratio = lognormal.standard_deviation / lognormal.mean;
  const double variance = std::log1p(ratio * ratio);
  return lognormal.mean *
         std::exp(std::sqrt(variance) * normal_quantile(probability) - variance / 2);
}

}  // namespace

double normal_cdf(double z) { return std::erfc(-z / std::numbers::sqrt2) / 2; }

double normal_quantile(double probability) {
  return -std::numbers::sqrt2 * boost::math::erfc_inv(2 * probability, NoThrow());
}

double quantile(const SweepDistribution& distribution, double probability) {
  switch (distribution.kind) {
    case SweepDistribution::Kind::uniform:
      return (1 - probability) * distribution.low + probability * distribution.high;
    case SweepDistribution::Kind::log_uniform:
      return distribution.low * std::pow(distribution.high / distribution.low, probability);
    case SweepDistribution::Kind::normal:
      return cut_normal_quantile(distribution, probability);
    case SweepDistribution::Kind::lognormal:
      return lognormal_quantile(distribution, probability);
    case SweepDistribution::Kind::triangular:
      return triangular_quantile(distribution, probability);
    case SweepDistribution::Kind::discrete:
      break;
  }
  throw std::logic_error("a discrete distribution has no quantile between its values");
}

std::size_t discrete_quantile(const SweepDistribution& distribution, double probability) {
  double sum = 0;
  std::size_t last = 0;  // rounding may leave the sum below 1
  for (std::size_t k = 0; k < distribution.weights.size(); ++k) {
    if (!(distribution.weights[k] > 0)) continue;
    last = k;
    sum += distribution.weights[k];
    if (probability < sum) break;
  }
  return last;
}

}  // namespace flexneck::pipeline
