// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/sweep/shapley.h"

#include <numeric>
#include <utility>

#include "pipeline/parameter_studies/sampling/counter_random.h"
#include "pipeline/parameter_studies/sampling/distribution.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr std::uint64_t kOuter = 6ULL << 32U;
constexpr std::uint64_t kInnerStream = 7ULL << 32U;
constexpr std::uint64_t kOrder = 8ULL << 32U;

/// Increments of the variance by each input, a column for each sample. The last input's lacks the
/// whole variance, which effects_of() adds.
MatrixXd increments(const MatrixXd& values, const std::vector<std::uint64_t>& samples,
                    const ShapleyPoints& points, std::vector<Index>& last_inputs) {
  constexpr Index kInner = ShapleyPoints::kInner;
  const Index inputs = (values.rows() - 1) / kInner + 1;
  MatrixXd added = MatrixXd::Zero(inputs, values.cols());
  for (Index k = 0; k < values.cols(); ++k) {
    const std::vector<Index> order = points.order(samples[static_cast<std::size_t>(k)]);
    double known = 0;
    for (Index j = 0; j + 1 < inputs; ++j) {
      const auto inner = values.col(k).segment(1 + kInner * j, kInner);
      const double variance = (inner.array() - inner.mean()).square().sum() / (kInner - 1);
      added(order[static_cast<std::size_t>(j)], k) = variance - known;
      known = variance;
    }
    added(order.back(), k) = -known;
    last_inputs.push_back(order.back());
  }
  return added;
}

}  // namespace

VectorXd ShapleyPoints::normal(std::uint64_t stream, std::uint64_t index) const {
  VectorXd numbers(dimensions_);
  for (int k = 0; k < dimensions_; ++k)
    numbers[k] = normal_quantile(
        open_unit(random_bits(seed_, stream + static_cast<std::uint64_t>(k), index)));
  return numbers;
}

std::vector<Index> ShapleyPoints::order(std::uint64_t sample) const {
  std::vector<Index> inputs(static_cast<std::size_t>(dimensions_));
  std::iota(inputs.begin(), inputs.end(), 0);
  for (std::size_t k = inputs.size(); k > 1; --k)  // shuffle of Fisher and Yates
    std::swap(inputs[k - 1], inputs[random_bits(seed_, kOrder + k, sample) % k]);
  return inputs;
}

VectorXd ShapleyPoints::point(std::uint64_t row) const {
  const std::uint64_t sample = row / rows_per_sample();
  const std::uint64_t within = row % rows_per_sample();
  if (within == 0)
    return probabilities(correlation_.factor() * normal(kOuter, sample * rows_per_sample()));
  const std::uint64_t count = (within - 1) / kInner + 1;  // number of inputs that are redrawn
  std::vector<Index> redrawn = order(sample);
  redrawn.resize(count);
  const VectorXd outer = correlation_.factor() * normal(kOuter, sample * rows_per_sample() + count);
  return probabilities(correlation_.redrawn(outer, redrawn, normal(kInnerStream, row)));
}

std::vector<Estimate> shapley_effects(const MatrixXd& values,
                                      const std::vector<std::uint64_t>& samples,
                                      const ShapleyPoints& points, std::uint64_t seed) {
  std::vector<Index> last_inputs;
  const MatrixXd added = increments(values, samples, points, last_inputs);
  const VectorXd centred = values.row(0).array() - values.row(0).mean();
  const auto effects_of = [&](const std::vector<Index>& members) -> VectorXd {
    const auto count = static_cast<double>(members.size());
    VectorXd sum = VectorXd::Zero(added.rows());
    VectorXd last = VectorXd::Zero(added.rows());
    double mean = 0;
    double square = 0;
    for (const Index member : members) {
      sum += added.col(member);
      last[last_inputs[static_cast<std::size_t>(member)]] += 1;
      mean += centred[member];
      square += centred[member] * centred[member];
    }
    const double variance = (square - mean * mean / count) / (count - 1);
    return (sum / variance + last) / count;
  };
  return bootstrap({values.cols(), seed, effects_of});
}

}  // namespace flexneck::pipeline
