// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace flexneck::pipeline {

/// Sums along the path that warps two curves onto each other.
struct WarpedSums {
  double difference = 0;  ///< sum of |computed - reference|
  double reference = 0;   ///< sum of |reference|
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
WarpedSums warped_sums(const Eigen::VectorXd& reference, const Eigen::VectorXd& computed,
                       Eigen::Index band);

}  // namespace flexneck::pipeline
