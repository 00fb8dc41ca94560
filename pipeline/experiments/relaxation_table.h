// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipeline/output/result_table.h"
#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// "relaxation": storage modulus and loss factor against frequency of the sections that relax in
/// the pendulum's cases, what their branches were fitted to and where they stand for the rubber. No
/// rows where nothing relaxes.
/// @param study  its sections with their stiffness
ResultTable relaxation_table(const Study& study);

}  // namespace flexneck::pipeline
