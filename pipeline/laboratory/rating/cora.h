// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace flexneck::pipeline {

/// Parameters of CORA with their names there; the values are the defaults of its version 4.0.5.
/// Lengths are fractions of the interval of evaluation, widths fractions of the largest absolute
/// value of the reference.
struct CoraParameters {
  // Interval of evaluation, if found automatically.
  /// A_THRES: the interval begins where the reference first reaches this value.
  double start_threshold = 0.03;
  /// B_THRES: the interval ends where the reference last has this value.
  double end_threshold = 0.075;
  double extension = 0.01;  ///< A_EVAL: extension of the interval at both ends
  /// B_DELTA_END: corridor about the last value if that is not near zero.
  double end_corridor = 0.2;
  // Corridor.
  double corridor_exponent = 2;  ///< K
  double inner = 0.05;           ///< a_0, half width
  double outer = 0.5;            ///< b_0, half width
  // Cross-correlation.
  double min_shift = 0.01;           ///< D_MIN, the phase rating is 1 for smaller shifts
  double max_shift = 0.12;           ///< D_MAX, the phase rating is 0 for larger shifts
  double min_overlap = 0.8;          ///< INT_MIN, minimum overlap after a shift
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

/// Parts of the rating, 0 to 1, and the quantities that they follow from.
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

/// Rates a curve against a reference by the method of CORA (Gehre, Gades, Wernicke: Objective
/// rating of signals using test and simulation responses, ESV 2009, 09-0407). Interpretations made
/// here: pipeline/manual/reference/ratings.md.
/// @param reference, computed  shape (n), at the same equidistant times of the interval of
/// evaluation, in the same unit
/// @throws InputError as check_rated() does, and for invalid parameters: widths that do not
/// increase, an exponent that is not positive, weights that do not add up to 1.
CoraRating rate_cora(const Eigen::VectorXd& reference, const Eigen::VectorXd& computed,
                     const CoraParameters& parameters = {});

/// Range of samples, first and last included.
struct SampleRange {
  Eigen::Index first, last;
};

/// The interval of evaluation that CORA finds automatically: from the first sample at which the
/// reference reaches start_threshold to the last one at which it has end_threshold; if its last
/// value is not below that, to where it last enters the corridor of end_corridor about its last
/// value; extended at both ends, within the curve. The whole curve if the interval is less than
/// kMinRatedSamples.
/// @param reference  shape (n), not all zero
SampleRange cora_interval(const Eigen::VectorXd& reference, const CoraParameters& parameters = {});

}  // namespace flexneck::pipeline
