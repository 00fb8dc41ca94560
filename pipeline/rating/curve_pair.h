// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace flexneck::pipeline {

/// Rated curves have at least so many samples: with fewer, a shift by one of them is more than 5 %
/// of the phase rating of ISO/TS 18571.
inline constexpr Eigen::Index kMinRatedSamples = 100;
/// And at most so many, 10 s at 10 kHz: time grows with the square.
inline constexpr Eigen::Index kMaxRatedSamples = 100'000;

/// @param reference, computed  shape (n), at the same equidistant times, of the same unit
/// @throws InputError unless both have the same permitted number of samples, are finite and vary:
/// nothing correlates with a constant, and it has no slope.
void check_rated(const Eigen::VectorXd& reference, const Eigen::VectorXd& computed);

/// What is left of two curves of n samples that are shifted against each other by m: n - |m|
/// samples.
struct Overlap {
  Eigen::VectorXd reference, computed;
};

/// @param shift  in samples, less than n; positive if the computed curve is the later one, which is
/// moved to earlier times then
Overlap overlap(const Eigen::VectorXd& reference, const Eigen::VectorXd& computed,
                Eigen::Index shift);

/// Whether the mean is taken away before two curves are correlated.
enum class Correlation { about_mean, about_zero };

struct BestShift {
  Eigen::Index samples = 0;  ///< as of overlap()
  double correlation = 0;    ///< there, -1 to 1
};

/// The shift that gives the largest correlation. Of correlations that differ by less than 1e-12 the
/// shift by the fewest samples counts, and of two the one of a computed curve that is late. Shifts
/// that leave nothing to correlate with, such as a constant about its mean, do not count; without
/// any other there is no shift, and the correlation is 0.
/// @param max_shift  in samples, less than n
BestShift best_shift(const Eigen::VectorXd& reference, const Eigen::VectorXd& computed,
                     Eigen::Index max_shift, Correlation kind);

/// Largest whole number of samples within a share of n; 0.2 of 600 is 120 in spite of rounding.
Eigen::Index samples_within(double share, Eigen::Index n);

/// Mean over the samples of what a corridor about the reference gives: 1 up to the inner half
/// width, 0 from the outer one on, ((outer - d) / (outer - inner))^exponent at a distance d
/// between.
/// @param inner, outer  shares of the largest absolute value of the reference, inner < outer
double corridor_rating(const Eigen::VectorXd& reference, const Eigen::VectorXd& computed,
                       double inner, double outer, double exponent);

}  // namespace flexneck::pipeline
