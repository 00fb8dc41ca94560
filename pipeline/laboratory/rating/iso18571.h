// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace flexneck::pipeline {

/// Sampling interval required by ISO/TS 18571.
inline constexpr double kIso18571Interval_s = 1e-4;

/// Weights of the parts in the overall rating.
inline constexpr double kIso18571CorridorWeight = 0.4;
inline constexpr double kIso18571OtherWeight = 0.2;  ///< for phase, magnitude and slope each

/// Parts of the rating, 0 to 1, and the quantities that they follow from.
struct Iso18571Rating {
  double corridor = 0;         ///< Z
  double phase = 0;            ///< P
  double magnitude = 0;        ///< M
  double slope = 0;            ///< S
  double overall = 0;          ///< R = 0.4 Z + 0.2 P + 0.2 M + 0.2 S
  Eigen::Index shift = 0;      ///< samples; positive if the computed curve is late
  double correlation = 0;      ///< correlation of the curves at that shift
  double magnitude_error = 0;  ///< sum of |C - T| over that of |T|, warped
  double slope_error = 0;      ///< sum of |slope differences| over that of |slopes of T|, warped
};

/// Rates a curve against a reference by ISO/TS 18571:2024. Choices that its definition leaves open,
/// and their effect on the rating: pipeline/manual/reference/ratings.md.
/// @param reference, computed  shape (n), sampled at 10 kHz at the same times, in the same unit
/// @throws InputError as check_rated() does.
Iso18571Rating rate_iso18571(const Eigen::VectorXd& reference, const Eigen::VectorXd& computed);

}  // namespace flexneck::pipeline
