// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipeline/plotting/figure.h"
#include "pipeline/report/results.h"

namespace flexneck::pipeline {

/// What each input does to the frequencies, to the first one with a body attached, to a bending
/// stiffness and to the mass: bars of d ln(quantity) / d ln(input), the longest first, a panel for
/// each quantity. From the tables of sensitivities.json; missing without them.
Figure tornado_figure(const Results& results);

}  // namespace flexneck::pipeline
