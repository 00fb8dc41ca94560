// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "pipeline/parameter_studies/sweep/bootstrap.h"
#include "pipeline/parameter_studies/sweep/correlation.h"

namespace flexneck::pipeline {

/// The rows of an estimate of Shapley effects after Song, Nelson and Staum (2016), SIAM/ASA J.
/// Uncertainty Quantification 4, algorithm 1, with a random order of the inputs for each sample,
/// one outer and three inner points, as they recommend. A sample has a separate point for the
/// variance, and for each beginning of the order except the whole three points that differ in these
/// inputs only, drawn given the others.
class ShapleyPoints {
 public:
  static constexpr int kInner = 3;

  /// @param correlation must outlive this
  ShapleyPoints(int dimensions, std::uint64_t seed, const Correlation& correlation)
      : dimensions_(dimensions), seed_(seed), correlation_(correlation) {}

  std::uint64_t rows_per_sample() const {
    return 1 + kInner * static_cast<std::uint64_t>(dimensions_ - 1);
  }
  /// The point of a row in the open unit cube, correlated.
  Eigen::VectorXd point(std::uint64_t row) const;
  /// The inputs of a sample in their random order.
  std::vector<Eigen::Index> order(std::uint64_t sample) const;

 private:
  Eigen::VectorXd normal(std::uint64_t stream, std::uint64_t index) const;

  int dimensions_;
  std::uint64_t seed_;
  const Correlation& correlation_;
};

/// Shapley effects: fractions of an output's variance, for correlated inputs too, that sum to 1:
/// the mean over all orders of the inputs of each one's increment of the variance that remains when
/// those after it are known. NaN if the output does not vary.
/// @param values  (rows_per_sample, n), a column for each sample
/// @param samples numbers of the samples, n of them
std::vector<Estimate> shapley_effects(const Eigen::MatrixXd& values,
                                      const std::vector<std::uint64_t>& samples,
                                      const ShapleyPoints& points, std::uint64_t seed);

}  // namespace flexneck::pipeline
