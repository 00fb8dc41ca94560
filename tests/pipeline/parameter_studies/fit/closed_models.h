// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "pipeline/parameter_studies/fit/fit_objective.h"
#include "pipeline/parameter_studies/sampling/counter_random.h"
#include "pipeline/parameter_studies/sampling/distribution.h"

namespace flexneck::testing {

using pipeline::FitModel;
using pipeline::FitObjective;
using pipeline::FitRange;
using pipeline::FitTerm;

/// A free oscillation with unknown amplitude, damping and frequency: a cos(2 pi f t) exp(-d t) at
/// 12 times within 1 s.
inline Eigen::VectorXd oscillation(const Eigen::VectorXd& parameters) {
  constexpr int kTimes = 12;
  Eigen::VectorXd values(kTimes);
  for (int k = 0; k < kTimes; ++k) {
    const double time = (k + 1.0) / kTimes;
    values[k] = parameters[0] * std::exp(-parameters[1] * time) *
                std::cos(2 * std::numbers::pi * parameters[2] * time);
  }
  return values;
}

inline FitModel model_of(Eigen::VectorXd (*values)(const Eigen::VectorXd&),
                         const std::vector<FitRange>& ranges) {
  return {values, pipeline::central_differences(values, ranges)};
}

/// A standard normal number as a function of seed and position.
inline double normal_number(std::uint64_t seed, std::uint64_t position) {
  return pipeline::normal_quantile(pipeline::open_unit(pipeline::random_bits(seed, 77, position)));
}

/// Targets, one for each observable.
inline std::vector<FitTerm> targets(const Eigen::VectorXd& values, double deviation) {
  std::vector<FitTerm> terms;
  for (Eigen::Index k = 0; k < values.size(); ++k)
    terms.push_back({"y" + std::to_string(k), values[k], deviation, {}, false});
  return terms;
}

inline std::vector<FitTerm> noisy(const Eigen::VectorXd& truth, double deviation,
                                  std::uint64_t seed) {
  Eigen::VectorXd values = truth;
  for (Eigen::Index k = 0; k < values.size(); ++k)
    values[k] += deviation * normal_number(seed, static_cast<std::uint64_t>(k));
  return targets(values, deviation);
}

}  // namespace flexneck::testing
