// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/reduction/mode_conventions.h"

#include <cmath>

#include "geometry/foundation/symmetric_pairs.h"

namespace flexneck::fe_modal {
namespace {

/// Relative difference of frequencies below which modes span one eigenspace.
constexpr double kSameFrequency = 1e-6;

using Motions = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Translations and length x rotations at the observed region, a column for each mode.
Motions observe(const EigenPairs& pairs, const FieldMap& field_map, const RigidAverage& seen,
                double length_m) {
  Motions motions(6, pairs.values.size());
  const std::vector<Eigen::Matrix3Xd> shapes = field_map.expand(pairs.vectors);
  for (Eigen::Index k = 0; k < pairs.values.size(); ++k) {
    motions.col(k) = seen.of(shapes[static_cast<std::size_t>(k)]);
  }
  motions.bottomRows<3>() *= length_m;
  return motions;
}

/// End of the group of equal frequencies that starts at `first`.
Eigen::Index end_of_group(const Eigen::VectorXd& values, Eigen::Index first) {
  Eigen::Index end = first + 1;
  // Values are squares of frequencies: their relative difference is twice as large.
  while (end < values.size() && values[end] - values[end - 1] < 2 * kSameFrequency * values[end]) {
    ++end;
  }
  return end;
}

/// Orthogonal matrix whose first column has the most fore-aft and least lateral motion.
Eigen::MatrixXd rotation_to_axes(const Motions& motions) {
  // Weights of x and y translation, x and y rotation: the minimum is fore-aft, the maximum lateral
  // motion.
  const Vector6d weights{{-1, 1, 0, 1, -1, 0}};
  const Eigen::MatrixXd contest = motions.transpose() * weights.asDiagonal() * motions;
  return symmetric_pairs(contest).vectors;
}

double sign_of_largest(const Eigen::VectorXd& values) {
  Eigen::Index largest = 0;
  values.cwiseAbs().maxCoeff(&largest);
  return values[largest] < 0 ? -1 : 1;
}

}  // namespace

void apply_conventions(EigenPairs& pairs, const FieldMap& field_map, const RigidAverage& seen,
                       double length_m) {
  Motions motions = observe(pairs, field_map, seen, length_m);
  for (Eigen::Index first = 0; first < pairs.values.size();) {
    const Eigen::Index count = end_of_group(pairs.values, first) - first;
    if (count > 1 && pairs.values[first] > 0) {
      const Eigen::MatrixXd rotation = rotation_to_axes(motions.middleCols(first, count));
      pairs.vectors.middleCols(first, count) *= rotation;
      motions.middleCols(first, count) *= rotation;
    }
    first += count;
  }
  for (Eigen::Index k = 0; k < pairs.values.size(); ++k) {
    pairs.vectors.col(k) *= sign_of_largest(motions.col(k));
  }
}

void apply_conventions(EigenPairs& pairs, const DofLayout& layout) {
  for (auto vector : pairs.vectors.colwise()) vector *= sign_of_largest(layout.whole(vector));
}

}  // namespace flexneck::fe_modal
