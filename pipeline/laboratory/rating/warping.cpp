// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/laboratory/rating/warping.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace flexneck::pipeline {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kUnreachable = std::numeric_limits<double>::infinity();

/// End of the best path to a pair of samples.
struct PathEnd {
  double cost = kUnreachable;
  WarpedSums sums;
};

}  // namespace

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

}  // namespace flexneck::pipeline
