// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipeline/results/plotting/figure.h"
#include "pipeline/results/report/results.h"

namespace flexneck::pipeline {

/// Effect of each input on the frequencies, on the first one with a body attached, on a bending
/// stiffness and on the mass: bars of d ln(quantity) / d ln(input), the longest first, a panel for
/// each quantity. From the tables of sensitivities.json; missing without them.
Figure tornado_figure(const Results& results);

}  // namespace flexneck::pipeline
