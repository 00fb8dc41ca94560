// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/sampling/unit_points.h"

#include <boost/random/sobol.hpp>
#include <stdexcept>

#include "pipeline/parameter_studies/sampling/counter_random.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Streams of random numbers by purpose; the dimension is added.
constexpr std::uint64_t kSample = 1ULL << 32U;
constexpr std::uint64_t kJitter = 2ULL << 32U;
constexpr std::uint64_t kOrder = 3ULL << 32U;
constexpr std::uint64_t kShift = 4ULL << 32U;

VectorXd random_point(std::uint64_t row, int dimensions, std::uint64_t seed) {
  VectorXd point(dimensions);
  for (int k = 0; k < dimensions; ++k)
    point[k] = open_unit(random_bits(seed, kSample + static_cast<std::uint64_t>(k), row));
  return point;
}

VectorXd latin_hypercube_point(std::uint64_t row, const UnitPoints& of) {
  VectorXd point(of.dimensions);
  for (int k = 0; k < of.dimensions; ++k) {
    const auto stream = static_cast<std::uint64_t>(k);
    const auto key = static_cast<std::uint32_t>(random_bits(of.seed, kOrder + stream, 0));
    const std::uint32_t part = permuted(static_cast<std::uint32_t>(row), of.samples, key);
    point[k] = (part + open_unit(random_bits(of.seed, kJitter + stream, row))) / of.samples;
  }
  return point;
}

VectorXd mixed_point(std::uint64_t row, const UnitPoints& of) {
  const std::uint64_t sample = row / of.rows_per_sample();
  const auto which = static_cast<Index>(row % of.rows_per_sample());
  const VectorXd both = shifted_sobol_point(sample, 2 * of.dimensions, of.seed);
  if (which == 1) return both.tail(of.dimensions);
  VectorXd point = both.head(of.dimensions);
  if (which > 1) point[which - 2] = both[of.dimensions + which - 2];
  return point;
}

}  // namespace

std::uint64_t UnitPoints::rows_per_sample() const {
  const auto count = static_cast<std::uint64_t>(dimensions);
  switch (plan) {
    case SweepPlan::sobol_indices:
      return count + 2;
    case SweepPlan::grid:
    case SweepPlan::list:
    case SweepPlan::shapley:
      throw std::logic_error("a plan without points of the unit cube");
    default:
      return 1;
  }
}

VectorXd UnitPoints::point(std::uint64_t row) const {
  switch (plan) {
    case SweepPlan::random:
      return random_point(row, dimensions, seed);
    case SweepPlan::latin_hypercube:
      return latin_hypercube_point(row, *this);
    case SweepPlan::sobol:
      return shifted_sobol_point(row, dimensions, seed);
    case SweepPlan::sobol_indices:
      return mixed_point(row, *this);
    default:
      throw std::logic_error("a plan without points of the unit cube");
  }
}

VectorXd shifted_sobol_point(std::uint64_t index, int dimensions, std::uint64_t seed) {
  const auto count = static_cast<std::uint64_t>(dimensions);
  boost::random::sobol sequence(count);
  // Boost omits the origin, the first point, without which the others are not evenly spread.
  if (index > 1) sequence.discard((index - 1) * count);
  VectorXd point(dimensions);
  for (int k = 0; k < dimensions; ++k) {
    const std::uint64_t bits = index == 0 ? 0 : sequence();
    point[k] = open_unit(bits ^ random_bits(seed, kShift + static_cast<std::uint64_t>(k), 0));
  }
  return point;
}

}  // namespace flexneck::pipeline
