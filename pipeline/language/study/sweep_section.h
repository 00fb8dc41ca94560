// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pipeline/language/document/study_document.h"

namespace flexneck::pipeline {

/// Choice of the rows of a sweep.
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

/// Distribution of a parameter; numbers in its unit.
struct SweepDistribution {
  enum class Kind { uniform, log_uniform, normal, lognormal, triangular, discrete };
  Kind kind = Kind::uniform;
  /// Bounds; a normal distribution may be truncated.
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  double mode = 0;  ///< most likely value of a triangular distribution
  double mean = 0;  ///< mean of the value itself, also for a lognormal distribution
  double standard_deviation = 0;
  std::vector<double> weights;  ///< weights of a discrete distribution's values; sum 1
};

/// Content of [[sweep.parameter]].
struct SweepParameter {
  std::string name;  ///< name of its column
  std::string key;   ///< dotted key in the study
  std::string unit;  ///< unit of its numbers; empty for pure ones
  /// Values, unless the distribution is continuous: numbers, or texts.
  std::vector<double> values;
  std::vector<std::string> texts;
  std::optional<SweepDistribution> distribution;  ///< none in a grid or a list

  std::size_t level_count() const { return texts.empty() ? values.size() : texts.size(); }
  bool is_continuous() const { return level_count() == 0; }
};

/// Content of [[sweep.correlation]]: correlation of the normal scores of two parameters (a Gaussian
/// copula), which is that of the parameters themselves if both are normal.
struct SweepCorrelation {
  std::array<std::size_t, 2> parameters{};
  double coefficient = 0;
};

/// Content of [sweep].
struct SweepSection {
  SweepPlan plan = SweepPlan::grid;
  int samples = 0;  ///< for all plans except grid and list
  int seed = 1;
  std::vector<std::string> outputs;
  std::vector<std::string> curves;  ///< curves whose percentile bands are wanted
  std::vector<SweepParameter> parameters;
  std::vector<SweepCorrelation> correlations;
};

std::span<const Key> sweep_keys();

/// Reads [sweep]. @throws InputError also for keys that the plan does not use.
SweepSection read_sweep(const StudyTable& table);

/// Reads [sweep] of a study. @throws InputError if it has none.
SweepSection read_sweep(const std::filesystem::path& study,
                        const std::vector<std::string>& settings);

}  // namespace flexneck::pipeline
