// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/sweep/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "pipeline/parameter_studies/sampling/counter_random.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr Index kResamples = 1000;
constexpr std::uint64_t kResample = 5ULL << 32U;
constexpr double kLowShare = 0.025;

}  // namespace

double sorted_quantile(const VectorXd& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<Index>(std::floor(place));
  const Index above = std::min(below + 1, sorted.size() - 1);
  const double weight = place - static_cast<double>(below);
  return (1 - weight) * sorted[below] + weight * sorted[above];
}

std::vector<Estimate> bootstrap(const Resampling& of) {
  std::vector<Index> members(static_cast<std::size_t>(of.samples));
  std::iota(members.begin(), members.end(), 0);
  const VectorXd values = of.figures_of(members);
  MatrixXd drawn(kResamples, values.size());
  for (Index r = 0; r < kResamples; ++r) {
    const std::uint64_t stream = kResample + static_cast<std::uint64_t>(r);
    for (std::size_t k = 0; k < members.size(); ++k)
      members[k] = static_cast<Index>(random_bits(of.seed, stream, k) %
                                      static_cast<std::uint64_t>(of.samples));
    drawn.row(r) = of.figures_of(members).transpose();
  }
  std::vector<Estimate> estimates;
  for (Index k = 0; k < values.size(); ++k) {
    VectorXd sorted = drawn.col(k);
    std::sort(sorted.begin(), sorted.end());
    estimates.push_back(
        {values[k], {sorted_quantile(sorted, kLowShare), sorted_quantile(sorted, 1 - kLowShare)}});
  }
  return estimates;
}

}  // namespace flexneck::pipeline
