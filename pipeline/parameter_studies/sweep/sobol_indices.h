// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "pipeline/parameter_studies/sweep/bootstrap.h"

namespace flexneck::pipeline {

/// Fractions of an output's variance due to an independent input: by itself, and with all
/// interactions that it takes part in.
struct SobolIndex {
  Estimate first;
  Estimate total;
};

/// First-order indices after Saltelli et al. (2010), Computer Physics Communications 181, table 2
/// (b), mean(yB (yAB - yA)) / V with yB less the mean of all; total ones after Jansen, ibid. (f),
/// mean((yA - yAB)^2) / 2 V. The variance V is that of A and B together.
/// @param values  (d + 2, n), a column for each sample: y of A, of B and of A with each coordinate
///                of B, as UnitPoints has its rows
/// @return an index for each input; NaN of all if the output does not vary
std::vector<SobolIndex> sobol_indices(const Eigen::MatrixXd& values, std::uint64_t seed);

}  // namespace flexneck::pipeline
