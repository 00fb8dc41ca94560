// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "pipeline/output/result_table.h"
#include "pipeline/sweep/bootstrap.h"
#include "pipeline/sweep/sobol_indices.h"
#include "pipeline/sweep/sweep_table.h"

namespace flexneck::pipeline {

/// What an output says of the parameters; empty where the plan is not for it.
struct Sensitivity {
  std::vector<SobolIndex> sobol;  ///< one for each parameter
  std::vector<Estimate> shapley;  ///< likewise
  std::uint64_t left_out = 0;     ///< samples of which a row has no such output
};

/// One for each output. A sample of which a row failed takes no part.
std::vector<Sensitivity> sensitivities(const SweepRows& sweep, const SweepTable& table);

/// "percentiles": of each output over all rows that have it; "sobol indices" or "shapley effects";
/// "failures" if there are any.
std::vector<ResultTable> sweep_tables(const SweepRows& sweep,
                                      const std::vector<OutputColumn>& outputs,
                                      const SweepTable& table,
                                      const std::vector<Sensitivity>& sensitivity);

}  // namespace flexneck::pipeline
