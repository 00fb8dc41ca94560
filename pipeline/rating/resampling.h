// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <Eigen/Core>

#include "pipeline/document/curve_file.h"

namespace flexneck::pipeline {

/// Curves whose samples lie farther apart are not rated: a millisecond is what the slopes of
/// ISO/TS 18571 are averaged over, so that less would be a rating of the interpolation.
inline constexpr double kMaxCurveInterval_s = 1e-3;

/// What of the time is rated; without a limit as far as both curves go.
struct AskedInterval {
  std::optional<double> from_s, to_s;
};

/// Two curves of the same unit at the same times, from_s + k interval_s.
struct ResampledPair {
  Eigen::VectorXd reference, computed;  ///< shape (n)
  double from_s = 0, interval_s = 0;
  double to_s() const { return from_s + interval_s * static_cast<double>(reference.size() - 1); }
  bool is_interpolated = false;  ///< samples of one of them were at other times
};

/// Both curves at the interval of ISO/TS 18571, interpolated linearly.
/// @throws InputError with the file for curves that have no time in common, do not cover the time
/// asked for, have samples that lie farther apart there than kMaxCurveInterval_s, or less or more
/// of them than a rating takes.
ResampledPair resampled(const Curve& reference, const Curve& computed, const AskedInterval& asked);

}  // namespace flexneck::pipeline
