// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/fit/history.h"

#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/parameter_studies/sampling/counter_random.h"
#include "pipeline/parameter_studies/sampling/distribution.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::VectorXd;

Share share_of(std::uint64_t count, std::uint64_t of) {
  Share share{count, of};
  if (of == 0) return share;
  constexpr double kOutside = 0.025;  // probability on either side
  using Binomial = boost::math::binomial_distribution<>;
  const auto trials = static_cast<double>(of);
  const auto successes = static_cast<double>(count);
  share.value = successes / trials;
  share.low = Binomial::find_lower_bound_on_p(trials, successes, kOutside);
  share.high = Binomial::find_upper_bound_on_p(trials, successes, kOutside);
  return share;
}

VectorXd prior_point(const FitObjective& objective, std::uint64_t seed, std::uint64_t number) {
  constexpr std::uint64_t kPriors = 5ULL << 32U;  // reserves a range of random numbers for priors
  VectorXd point(objective.parameter_count());
  for (Index k = 0; k < point.size(); ++k) {
    const double unit =
        open_unit(random_bits(seed, kPriors + static_cast<std::uint64_t>(k), number));
    const FitRange& range = objective.ranges()[static_cast<std::size_t>(k)];
    if (!range.prior) {
      point[k] = unit;
      continue;
    }
    SweepDistribution normal;
    normal.kind = SweepDistribution::Kind::normal;
    normal.mean = range.prior->mean;
    normal.standard_deviation = range.prior->deviation;
    normal.low = range.from;
    normal.high = range.to;
    point[k] = (quantile(normal, unit) - range.from) / range.width();
  }
  return point;
}

std::vector<std::pair<std::string, bool>> targets_of(const FitObjective& objective) {
  std::vector<std::pair<std::string, bool>> targets;
  for (const FitTerm& term : objective.terms())
    if (targets.empty() || targets.back().first != term.target)
      targets.emplace_back(term.target, term.is_held_out);
  return targets;
}

std::vector<bool> met_targets(const FitObjective& objective, const VectorXd& values,
                              double deviations) {
  const std::vector<FitTerm>& terms = objective.terms();
  std::vector<bool> met;
  for (std::size_t first = 0; first < terms.size();) {
    std::size_t end = first;
    double squares = 0;
    bool are_met = true;
    for (; end < terms.size() && terms[end].target == terms[first].target; ++end) {
      const double value = values[static_cast<Index>(end)];
      squares += std::pow(terms[end].residual(value), 2);
      are_met = are_met && terms[end].is_met(value, deviations);
    }
    const bool is_curve = end > first + 1 && !terms[first].window;
    met.push_back(is_curve ? std::sqrt(squares / static_cast<double>(end - first)) <= deviations
                           : are_met);
    first = end;
  }
  return met;
}

}  // namespace flexneck::pipeline
