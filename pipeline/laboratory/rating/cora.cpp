// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/laboratory/rating/cora.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/foundation/error.h"
#include "pipeline/laboratory/rating/curve_pair.h"

namespace flexneck::pipeline {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Fails if a condition is false; conditions are written so that NaN is refused, too.
void require(bool is_right, const std::string& expected) {
  if (!is_right) throw InputError("CORA's parameters: expected " + expected);
}

void check(const CoraParameters& p) {
  require(p.inner >= 0 && p.inner < p.outer && std::isfinite(p.outer), "0 <= a_0 < b_0");
  require(p.min_shift >= 0 && p.min_shift < p.max_shift && std::isfinite(p.max_shift),
          "0 <= D_MIN < D_MAX");
  require(p.min_overlap > 0 && p.min_overlap <= 1, "0 < INT_MIN <= 1");
  for (const double exponent :
       {p.corridor_exponent, p.progression_exponent, p.size_exponent, p.phase_exponent})
    require(exponent > 0 && std::isfinite(exponent), "positive exponents K, K_V, K_G and K_P");
  for (const double weight : {p.corridor_weight, p.cross_correlation_weight, p.progression_weight,
                              p.size_weight, p.phase_weight})
    require(weight >= 0, "weights that are not negative");
  require(std::abs(p.corridor_weight + p.cross_correlation_weight - 1) < 1e-9, "G_1 + G_2 = 1");
  require(std::abs(p.progression_weight + p.size_weight + p.phase_weight - 1) < 1e-9,
          "G_V + G_G + G_P = 1");
}

/// Sum of squares of the computed curve over the reference's; neither can overflow.
double energy_ratio(const Overlap& pair) {
  const double ratio = pair.computed.stableNorm() / pair.reference.stableNorm();
  return ratio * ratio;
}

/// Rating of the size by the smaller energy over the larger one.
double size_rating(double ratio, double exponent) {
  if (!(ratio > 0)) return 0;
  return std::pow(std::min(ratio, 1 / ratio), exponent);
}

/// Last sample of the interval of evaluation.
Index last_evaluated(const VectorXd& shares, const CoraParameters& p) {
  Index last = shares.size() - 1;
  if (std::abs(shares[last]) < p.end_threshold) {
    while (last > 0 && std::abs(shares[last]) < p.end_threshold) --last;
    return last;
  }
  const double end = shares[last];
  while (last > 0 && std::abs(shares[last - 1] - end) <= p.end_corridor) --last;
  return last;
}

}  // namespace

CoraRating rate_cora(const VectorXd& reference, const VectorXd& computed,
                     const CoraParameters& parameters) {
  check(parameters);
  check_rated(reference, computed);
  const CoraParameters& p = parameters;
  const Index n = reference.size();
  CoraRating rating;
  rating.corridor = corridor_rating(reference, computed, p.inner, p.outer, p.corridor_exponent);

  const BestShift best = best_shift(reference, computed, samples_within(1 - p.min_overlap, n),
                                    Correlation::about_zero);
  rating.shift = best.samples;
  rating.correlation = best.correlation;
  rating.progression =
      std::pow(std::clamp((1 + best.correlation) / 2, 0.0, 1.0), p.progression_exponent);
  rating.energy_ratio = energy_ratio(overlap(reference, computed, best.samples));
  rating.size = size_rating(rating.energy_ratio, p.size_exponent);
  // Fraction of t_max - t_min.
  const double share = static_cast<double>(std::abs(best.samples)) / static_cast<double>(n - 1);
  rating.phase = std::pow(std::clamp((p.max_shift - share) / (p.max_shift - p.min_shift), 0.0, 1.0),
                          p.phase_exponent);

  rating.cross_correlation = p.progression_weight * rating.progression +
                             p.size_weight * rating.size + p.phase_weight * rating.phase;
  rating.overall =
      p.corridor_weight * rating.corridor + p.cross_correlation_weight * rating.cross_correlation;
  return rating;
}

SampleRange cora_interval(const VectorXd& reference, const CoraParameters& parameters) {
  const VectorXd shares = reference / reference.lpNorm<Eigen::Infinity>();
  Index first = 0;
  while (first + 1 < shares.size() && std::abs(shares[first]) < parameters.start_threshold) ++first;
  const Index last = std::max(first, last_evaluated(shares, parameters));
  const Index more = samples_within(parameters.extension, last - first);
  const SampleRange range = {std::max<Index>(0, first - more),
                             std::min(shares.size() - 1, last + more)};
  if (range.last - range.first + 1 < kMinRatedSamples) return {0, shares.size() - 1};
  return range;
}

}  // namespace flexneck::pipeline
