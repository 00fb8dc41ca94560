// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pipeline/document/study_document.h"

namespace flexneck::pipeline {

/// How the rows of a sweep are chosen.
enum class SweepPlan {
  grid,             ///< each value of a parameter with each of the others; the last varies fastest
  list,             ///< the first values of all parameters, then the second ones, …
  random,           ///< independent samples
  latin_hypercube,  ///< one sample in each of `samples` equally probable parts of each parameter
  sobol,            ///< a Sobol' sequence
  sobol_indices,    ///< two Sobol' samples and their mixtures, for Sobol' indices
  shapley,          ///< conditional samples, for Shapley effects
};
std::vector<std::string> sweep_plan_names();

/// How a parameter is distributed; numbers in its unit.
struct SweepDistribution {
  enum class Kind { uniform, log_uniform, normal, lognormal, triangular, discrete };
  Kind kind = Kind::uniform;
  double low = -std::numeric_limits<double>::infinity();  ///< a normal one may be cut off
  double high = std::numeric_limits<double>::infinity();
  double mode = 0;  ///< most likely value of a triangular one
  double mean = 0;  ///< of the value itself, of a lognormal one too
  double standard_deviation = 0;
  std::vector<double> weights;  ///< of the values of a discrete one; sum 1
};

/// [[sweep.parameter]]
struct SweepParameter {
  std::string name;  ///< of its column
  std::string key;   ///< dotted, of the study
  std::string unit;  ///< of its numbers; empty for pure ones
  /// What it takes on, unless it is distributed continuously: numbers, or texts.
  std::vector<double> values;
  std::vector<std::string> texts;
  std::optional<SweepDistribution> distribution;  ///< none in a grid or a list

  std::size_t level_count() const { return texts.empty() ? values.size() : texts.size(); }
  bool is_continuous() const { return level_count() == 0; }
};

/// [[sweep.correlation]]: of the normal scores of two parameters (a Gaussian copula), which is that
/// of the parameters themselves if both are normal.
struct SweepCorrelation {
  std::array<std::size_t, 2> parameters{};
  double coefficient = 0;
};

/// [sweep]
struct SweepSection {
  SweepPlan plan = SweepPlan::grid;
  int samples = 0;  ///< of all plans but grid and list
  int seed = 1;
  std::vector<std::string> outputs;
  std::vector<std::string> curves;  ///< whose percentile bands are wanted
  std::vector<SweepParameter> parameters;
  std::vector<SweepCorrelation> correlations;
};

std::span<const Key> sweep_keys();

/// @throws InputError for keys that the plan has no use for, too.
SweepSection read_sweep(const StudyTable& table);

/// [sweep] of a study. @throws InputError if it has none.
SweepSection read_sweep(const std::filesystem::path& study,
                        const std::vector<std::string>& settings);

}  // namespace flexneck::pipeline
