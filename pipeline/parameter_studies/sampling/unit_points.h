// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "pipeline/language/study/sweep_section.h"

namespace flexneck::pipeline {

/// Points of the unit cube, each a function of its row: any of them can be computed without the
/// previous ones, and is always the same. All coordinates lie in the open interval (0, 1).
struct UnitPoints {
  SweepPlan plan = SweepPlan::random;  ///< neither grid nor list
  std::uint32_t samples = 0;
  int dimensions = 0;
  std::uint64_t seed = 1;

  /// Number of rows of a sample, which estimates of indices need together; 1 for plans without
  /// indices.
  /// - sobol_indices: A, B and, for each dimension, A with that coordinate of B (Saltelli et al.
  ///   2010, table 1, "A_B^(i)"), d + 2.
  std::uint64_t rows_per_sample() const;
  std::uint64_t row_count() const { return samples * rows_per_sample(); }

  /// The point of a row.
  /// @pre row < row_count(); plan is not shapley, whose rows depend on the correlations
  Eigen::VectorXd point(std::uint64_t row) const;
};

/// Element `index` of the Sobol' sequence with the direction numbers of Joe and Kuo (2008), the
/// origin first, shifted digit by digit at random (Owen 1998 calls it a digital shift): the first
/// 2^m points still have one in each of 2^m equal parts of each coordinate.
Eigen::VectorXd shifted_sobol_point(std::uint64_t index, int dimensions, std::uint64_t seed);

}  // namespace flexneck::pipeline
