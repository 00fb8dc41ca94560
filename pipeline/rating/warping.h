// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace flexneck::pipeline {

/// Sums along the path that warps two curves onto each other.
struct WarpedSums {
  double difference = 0;  ///< of |computed - reference|
  double reference = 0;   ///< of |reference|
};

/// Dynamic time warping: from the pair of first samples to that of last ones, each step goes on in
/// the computed curve, in the reference or in both, and the sum of the squared differences of all
/// pairs on the path is the least. Of predecessors with equal sums the one with the same sample of
/// the reference is taken, then that with the same sample of the computed curve, then the diagonal.
///
/// The sums are carried along with the costs, so that no path has to be traced back: work n times
/// band, memory in proportion to the band.
/// @param reference, computed  shape (n), n > 0, of the same unit
/// @param band  samples i and j are paired if |i - j| < band; at least 1
WarpedSums warped_sums(const Eigen::VectorXd& reference, const Eigen::VectorXd& computed,
                       Eigen::Index band);

}  // namespace flexneck::pipeline
