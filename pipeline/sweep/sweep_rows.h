// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "pipeline/sampling/unit_points.h"
#include "pipeline/sampling/varied_key.h"
#include "pipeline/study/sweep_section.h"
#include "pipeline/sweep/correlation.h"
#include "pipeline/sweep/shapley.h"

namespace flexneck::pipeline {

/// What the rows of a sweep set in the study: each a function of its number alone, so that any row
/// can be had by anyone and is the same.
class SweepRows {
 public:
  static constexpr std::uint64_t kMaxRows = 1'000'000'000;

  /// @throws InputError for a unit that its key does not have, correlations that contradict each
  /// other, or more than kMaxRows rows.
  explicit SweepRows(SweepSection section);
  SweepRows(const SweepRows&) = delete;
  SweepRows& operator=(const SweepRows&) = delete;

  std::uint64_t count() const { return count_; }
  /// That a sample of indices takes together; 1 of other plans.
  std::uint64_t rows_per_sample() const;
  const SweepSection& section() const { return section_; }
  /// SI unit of each parameter; "1" for pure numbers and texts.
  const std::vector<std::string>& units() const { return units_; }

  /// "key=value" for each parameter.
  std::vector<std::string> settings(std::uint64_t row) const;
  /// Values in SI units; of a text its position.
  Eigen::VectorXd numbers(std::uint64_t row) const;
  /// Two different settings of one parameter; of one with a single value that one twice.
  TwoSettings two_settings(std::size_t parameter) const;

  /// @pre plan shapley
  const ShapleyPoints& shapley() const { return shapley_; }

 private:
  /// What parameters take on: a number in their own unit, or the position of a text.
  std::vector<double> values(std::uint64_t row) const;
  double value_at(const SweepParameter& parameter, double probability) const;
  static std::string setting(const SweepParameter& parameter, double value);

  SweepSection section_;
  Correlation correlation_;
  ShapleyPoints shapley_;
  UnitPoints points_;
  std::uint64_t count_ = 0;
  std::vector<std::string> units_;
  std::vector<double> factors_;  ///< to SI
};

}  // namespace flexneck::pipeline
