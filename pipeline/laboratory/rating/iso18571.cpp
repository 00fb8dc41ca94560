// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/laboratory/rating/iso18571.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "pipeline/laboratory/rating/curve_pair.h"

namespace flexneck::pipeline {

namespace {

/// Sums along the path that warps two curves onto each other.
struct WarpedSums {
  double difference = 0;  ///< sum of |computed - reference|
  double reference = 0;   ///< sum of |reference|
};

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kUnreachable = std::numeric_limits<double>::infinity();

/// End of the best path to a pair of samples.
struct PathEnd {
  double cost = kUnreachable;
  WarpedSums sums;
};

/// Dynamic time warping: from the pair of first samples to that of last ones, each step advances in
/// the computed curve, in the reference or in both, and the sum of the squared differences of all
/// pairs on the path is minimal. Among predecessors with equal sums the one with the same sample of
/// the reference is taken, then that with the same sample of the computed curve, then the diagonal.
///
/// The sums are carried along with the costs, so that no path has to be traced back: work n times
/// band, memory proportional to the band.
/// @param reference, computed  shape (n), n > 0, in the same unit
/// @param band  samples i and j are paired if |i - j| < band; at least 1
WarpedSums warped_sums(const VectorXd& reference, const VectorXd& computed, Index band) {
  const Index count = reference.size();
  band = std::min(band, count);
  // Element 1 + k holds the pair of samples i of the computed curve and i + k - (band - 1) of the
  // reference. Until row i overwrites them, elements hold row i - 1, moved by one sample: the
  // element itself is the predecessor on the diagonal, the next one that with the same sample of
  // the reference. The elements at both ends stay unreachable.
  const Index width = 2 * band - 1;
  std::vector<PathEnd> row(static_cast<std::size_t>(width + 2));
  row[static_cast<std::size_t>(band)] = {0, {}};  // before the first pair
  for (Index i = 0; i < count; ++i) {
    const double value = computed[i];
    for (Index k = 0; k < width; ++k) {
      const Index j = i + k - (band - 1);
      PathEnd& here = row[static_cast<std::size_t>(1 + k)];
      if (j < 0 || j >= count) {
        here = {};
        continue;
      }
      const PathEnd& same_reference = row[static_cast<std::size_t>(2 + k)];
      const PathEnd& same_computed = row[static_cast<std::size_t>(k)];
      const PathEnd* before = &same_reference;
      if (same_computed.cost < before->cost) before = &same_computed;
      if (here.cost < before->cost) before = &here;
      const double difference = std::abs(value - reference[j]);
      here = {
          before->cost + difference * difference,
          {before->sums.difference + difference, before->sums.reference + std::abs(reference[j])}};
    }
  }
  return row[static_cast<std::size_t>(band)].sums;
}

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kInnerCorridor = 0.05;  ///< half width over the largest |T|
constexpr double kOuterCorridor = 0.5;
constexpr double kCorridorExponent = 2;
constexpr double kMaxShift = 0.2;  ///< fraction of the length at which the phase rating reaches 0
constexpr double kWarpingWindow = 0.1;  ///< fraction of the length of the shifted curves' overlap
constexpr double kMaxMagnitudeError = 0.5;
constexpr double kMaxSlopeError = 2;
constexpr Index kSlopeHalfWindow = 4;  ///< nine points
/// Bound relative to the largest |T|: values beyond it rate 0, and their squares must not overflow.
constexpr double kFarAway = 1e100;

/// Rating that falls linearly from 1 without an error to 0 at the maximum error.
double linear_rating(double error, double max_error) {
  return std::clamp(1 - error / max_error, 0.0, 1.0);
}

/// Sum of errors over the sum of reference values; infinite if only the latter is zero.
double relative_error(double error, double reference) {
  return reference > 0 ? error / reference : error > 0 ? HUGE_VAL : 0;
}

/// Slopes per sample: central differences, one-sided at the ends; then means over nine points, over
/// 1, 3, 5 and 7 at the ends.
VectorXd smoothed_slopes(const VectorXd& curve) {
  const Index n = curve.size();
  VectorXd slopes(n);
  slopes[0] = curve[1] - curve[0];
  slopes[n - 1] = curve[n - 1] - curve[n - 2];
  slopes.segment(1, n - 2) = (curve.tail(n - 2) - curve.head(n - 2)) / 2;
  VectorXd smoothed(n);
  for (Index k = 0; k < n; ++k) {
    const Index half = std::min({kSlopeHalfWindow, k, n - 1 - k});
    smoothed[k] = slopes.segment(k - half, 2 * half + 1).mean();
  }
  return smoothed;
}

}  // namespace

Iso18571Rating rate_iso18571(const VectorXd& reference, const VectorXd& computed) {
  check_rated(reference, computed);
  Iso18571Rating rating;
  rating.corridor =
      corridor_rating(reference, computed, kInnerCorridor, kOuterCorridor, kCorridorExponent);

  const Index n = reference.size();
  const BestShift best =
      best_shift(reference, computed, samples_within(kMaxShift, n), Correlation::about_mean);
  rating.shift = best.samples;
  rating.correlation = best.correlation;
  rating.phase = linear_rating(static_cast<double>(std::abs(best.samples)),
                               kMaxShift * static_cast<double>(n));

  const double norm = reference.lpNorm<Eigen::Infinity>();
  const VectorXd scaled = (computed / norm).cwiseMin(kFarAway).cwiseMax(-kFarAway);
  const Overlap pair = overlap(reference / norm, scaled, best.samples);
  const auto band = static_cast<Index>(
      std::ceil(kWarpingWindow * static_cast<double>(pair.reference.size()) - 1e-9));
  const WarpedSums warped = warped_sums(pair.reference, pair.computed, band);
  rating.magnitude_error = relative_error(warped.difference, warped.reference);
  rating.magnitude = linear_rating(rating.magnitude_error, kMaxMagnitudeError);

  const VectorXd slopes = smoothed_slopes(pair.reference);
  rating.slope_error =
      relative_error((smoothed_slopes(pair.computed) - slopes).lpNorm<1>(), slopes.lpNorm<1>());
  rating.slope = linear_rating(rating.slope_error, kMaxSlopeError);
  rating.overall = kIso18571CorridorWeight * rating.corridor +
                   kIso18571OtherWeight * (rating.phase + rating.magnitude + rating.slope);
  return rating;
}

}  // namespace flexneck::pipeline
