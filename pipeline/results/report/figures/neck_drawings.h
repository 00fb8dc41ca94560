// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "pipeline/results/plotting/figure.h"
#include "pipeline/results/report/results.h"

namespace flexneck::pipeline {

/// Figures 1, 2, 5 and 7: the paper's drawings, from the study's dimensions and the computed
/// motions. None for a structure other than the neck.
std::vector<Figure> neck_drawings(const Results& results, const Study& study);

}  // namespace flexneck::pipeline
