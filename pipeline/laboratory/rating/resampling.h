// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <Eigen/Core>

#include "pipeline/laboratory/curve_file.h"

namespace flexneck::pipeline {

/// Maximum interval between samples of rated curves: slopes of ISO/TS 18571 are averaged over a
/// millisecond, so that with longer intervals the interpolation would be rated.
inline constexpr double kMaxCurveInterval_s = 1e-3;

/// Interval to be rated; without a limit as far as both curves reach.
struct AskedInterval {
  std::optional<double> from_s, to_s;
};

/// Two curves of the same unit at the same times, from_s + k interval_s.
struct ResampledPair {
  Eigen::VectorXd reference, computed;  ///< shape (n)
  double from_s = 0, interval_s = 0;
  double to_s() const { return from_s + interval_s * static_cast<double>(reference.size() - 1); }
  bool is_interpolated = false;  ///< true if one curve had samples at other times
};

/// Samples both curves at the interval of ISO/TS 18571, interpolated linearly.
/// @throws InputError with the file for curves that have no time in common, do not cover the
/// interval asked for, have sample intervals there larger than kMaxCurveInterval_s, or fewer or
/// more samples than a rating allows.
ResampledPair resampled(const Curve& reference, const Curve& computed, const AskedInterval& asked);

}  // namespace flexneck::pipeline
