// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "pipeline/results/plotting/figure.h"
#include "pipeline/results/report/results.h"

namespace flexneck::pipeline {

/// Figures 3 and 4: the mesh, and its first mode.
std::vector<Figure> mesh_figures(const Results& results);

}  // namespace flexneck::pipeline
