// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace flexneck::pipeline {

/// Parameters of CORA with their names there; the values are the defaults of its version 4.0.5.
/// Lengths and widths are shares, of the interval of evaluation and of the largest absolute value
/// of the reference.
struct CoraParameters {
  // Interval of evaluation, where it is found automatically.
  double start_threshold = 0.03;  ///< A_THRES: it begins where the reference first is so large
  double end_threshold = 0.075;   ///< B_THRES: and ends where it was so large last
  double extension = 0.01;        ///< A_EVAL: then longer by this share at both ends
  double end_corridor = 0.2;      ///< B_DELTA_END: about a last value that is not near zero
  // Corridor.
  double corridor_exponent = 2;  ///< K
  double inner = 0.05;           ///< a_0, half width
  double outer = 0.5;            ///< b_0, half width
  // Cross-correlation.
  double min_shift = 0.01;           ///< D_MIN, up to which the phase is rated 1
  double max_shift = 0.12;           ///< D_MAX, from which it is rated 0
  double min_overlap = 0.8;          ///< INT_MIN, of the interval that a shift leaves
  double progression_exponent = 10;  ///< K_V
  double size_exponent = 1;          ///< K_G
  double phase_exponent = 1;         ///< K_P
  // Weights.
  double corridor_weight = 0.5;           ///< G_1
  double cross_correlation_weight = 0.5;  ///< G_2
  double progression_weight = 0.5;        ///< G_V
  double size_weight = 0.25;              ///< G_G
  double phase_weight = 0.25;             ///< G_P
};

/// Parts of the rating, 0 to 1, with what they follow from.
struct CoraRating {
  double corridor = 0;           ///< C1
  double progression = 0;        ///< V
  double size = 0;               ///< G
  double phase = 0;              ///< P
  double cross_correlation = 0;  ///< C2 = G_V V + G_G G + G_P P
  double overall = 0;            ///< C = G_1 C1 + G_2 C2
  Eigen::Index shift = 0;        ///< samples; positive if the computed curve is late
  double correlation = 0;        ///< K of the curves at that shift, about zero
  double energy_ratio = 0;       ///< sum of squares of the computed curve over the reference's
};

/// Rating of a curve against a reference by the method of CORA (Gehre, Gades, Wernicke: Objective
/// rating of signals using test and simulation responses, ESV 2009, 09-0407). What is our reading:
/// pipeline/rating/README.md.
/// @param reference, computed  shape (n), at the same equidistant times of the interval of
/// evaluation, of the same unit
/// @throws InputError as check_rated() does, and for parameters that make no sense: widths that do
/// not increase, an exponent that is not positive, weights that do not add up to 1.
CoraRating rate_cora(const Eigen::VectorXd& reference, const Eigen::VectorXd& computed,
                     const CoraParameters& parameters = {});

/// Samples first to last.
struct SampleRange {
  Eigen::Index first, last;
};

/// The interval of evaluation that CORA finds by itself: from the first sample at which the
/// reference comes to start_threshold to the last one at which it has end_threshold; if it does
/// not end below that, to where it last enters the corridor of end_corridor about its last value;
/// longer by the extension at both ends, within the curve. All of the curve if that is less than
/// kMinRatedSamples.
/// @param reference  shape (n), not all zero
SampleRange cora_interval(const Eigen::VectorXd& reference, const CoraParameters& parameters = {});

}  // namespace flexneck::pipeline
