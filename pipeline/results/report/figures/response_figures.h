// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "pipeline/results/plotting/figure.h"
#include "pipeline/results/report/results.h"

namespace flexneck::pipeline {

/// Figures 6 and 8 to 16: the results of the experiments, with the variants that were run.
std::vector<Figure> response_figures(const Results& results, const Study& study);

}  // namespace flexneck::pipeline
