// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace flexneck::pipeline {

/// Minimum number of samples of rated curves: with fewer, a shift by one of them is more than 5 %
/// of the phase rating of ISO/TS 18571.
inline constexpr Eigen::Index kMinRatedSamples = 100;
/// Maximum number of samples, 10 s at 10 kHz: time grows with the square.
inline constexpr Eigen::Index kMaxRatedSamples = 100'000;

/// Checks that two curves can be rated.
/// @param reference, computed  shape (n), at the same equidistant times, in the same unit
/// @throws InputError unless both have the same permitted number of samples, are finite and vary: a
/// constant has no correlation and no slope.
void check_rated(const Eigen::VectorXd& reference, const Eigen::VectorXd& computed);

/// Overlap of two curves of n samples that are shifted against each other by m: n - |m| samples.
struct Overlap {
  Eigen::VectorXd reference, computed;
};

/// Overlap of two curves.
/// @param shift  in samples, less than n; positive if the computed curve is late, which then is
/// moved to earlier times
Overlap overlap(const Eigen::VectorXd& reference, const Eigen::VectorXd& computed,
                Eigen::Index shift);

/// Choice whether the mean is subtracted before two curves are correlated.
enum class Correlation { about_mean, about_zero };

struct BestShift {
  Eigen::Index samples = 0;  ///< as in overlap()
  double correlation = 0;    ///< correlation at that shift, -1 to 1
};

/// The shift with the largest correlation. Among correlations that differ by less than 1e-12 the
/// smallest shift counts, and of two equal ones that of a late computed curve. Shifts at which the
/// overlap has no correlation, such as a constant about its mean, do not count; without any other,
/// the shift and the correlation are 0.
/// @param max_shift  in samples, less than n
BestShift best_shift(const Eigen::VectorXd& reference, const Eigen::VectorXd& computed,
                     Eigen::Index max_shift, Correlation kind);

/// Largest number of samples within a fraction of n; 0.2 of 600 is 120 in spite of rounding.
Eigen::Index samples_within(double share, Eigen::Index n);

/// Mean over the samples of the rating by a corridor about the reference: 1 up to the inner half
/// width, 0 from the outer one on, ((outer - d) / (outer - inner))^exponent at a distance d
/// between.
/// @param inner, outer  half widths over the largest absolute value of the reference, inner < outer
double corridor_rating(const Eigen::VectorXd& reference, const Eigen::VectorXd& computed,
                       double inner, double outer, double exponent);

}  // namespace flexneck::pipeline
