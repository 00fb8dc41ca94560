// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "pipeline/parameter_studies/sweep/bootstrap.h"
#include "pipeline/parameter_studies/sweep/sobol_indices.h"
#include "pipeline/parameter_studies/sweep/sweep_table.h"
#include "pipeline/process/result_table.h"

namespace flexneck::pipeline {

/// Dependence of an output on the parameters; empty if the plan does not provide it.
struct Sensitivity {
  std::vector<SobolIndex> sobol;  ///< one per parameter
  std::vector<Estimate> shapley;  ///< one per parameter
  std::uint64_t left_out = 0;     ///< number of samples in which a row lacks the output
};

/// Sensitivities, one for each output. Samples with a failed row are excluded.
std::vector<Sensitivity> sensitivities(const SweepRows& sweep, const SweepTable& table);

/// Tables "percentiles" of each output over all rows that have it; "sobol indices" or "shapley
/// effects"; "failures" if there are any.
std::vector<ResultTable> sweep_tables(const SweepRows& sweep,
                                      const std::vector<OutputColumn>& outputs,
                                      const SweepTable& table,
                                      const std::vector<Sensitivity>& sensitivity);

}  // namespace flexneck::pipeline
