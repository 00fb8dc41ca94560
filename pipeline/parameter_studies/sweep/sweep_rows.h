// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "pipeline/language/study/sweep_section.h"
#include "pipeline/parameter_studies/sampling/unit_points.h"
#include "pipeline/parameter_studies/sampling/varied_key.h"
#include "pipeline/parameter_studies/sweep/correlation.h"
#include "pipeline/parameter_studies/sweep/shapley.h"

namespace flexneck::pipeline {

/// Settings of a sweep's rows in the study: each a function of its number alone, so that any
/// process can compute any row with the same result.
class SweepRows {
 public:
  static constexpr std::uint64_t kMaxRows = 1'000'000'000;

  /// @throws InputError for a unit that its key does not have, correlations that contradict each
  /// other, or more than kMaxRows rows.
  explicit SweepRows(SweepSection section);
  SweepRows(const SweepRows&) = delete;
  SweepRows& operator=(const SweepRows&) = delete;

  std::uint64_t count() const { return count_; }
  /// Number of rows of a sample, which indices need together; 1 for other plans.
  std::uint64_t rows_per_sample() const;
  const SweepSection& section() const { return section_; }
  /// SI unit of each parameter; "1" for pure numbers and texts.
  const std::vector<std::string>& units() const { return units_; }

  /// Settings "key=value", one for each parameter.
  std::vector<std::string> settings(std::uint64_t row) const;
  /// Values in SI units; for a text its index.
  Eigen::VectorXd numbers(std::uint64_t row) const;
  /// Two different settings of one parameter; for one with a single value that one twice.
  TwoSettings two_settings(std::size_t parameter) const;

  /// @pre plan shapley
  const ShapleyPoints& shapley() const { return shapley_; }

 private:
  /// Values of the parameters: a number in their own unit, or the index of a text.
  std::vector<double> values(std::uint64_t row) const;
  double value_at(const SweepParameter& parameter, double probability) const;
  static std::string setting(const SweepParameter& parameter, double value);

  SweepSection section_;
  Correlation correlation_;
  ShapleyPoints shapley_;
  UnitPoints points_;
  std::uint64_t count_ = 0;
  std::vector<std::string> units_;
  std::vector<double> factors_;  ///< factors to SI units
};

}  // namespace flexneck::pipeline
