// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipeline/cli/commands.h"

namespace flexneck::pipeline {

/// Judges the study's tests by the runs of their cases, prints the verdicts and writes
/// verdicts.json. Cases that have not been run are reported.
/// @throws InputError if a run stems from other values or is incomplete.
void write_verdicts(const CommandInput& input);

/// Returns whether a study has tests of regulations or tests with measured data.
bool has_tests(const Study& study);

}  // namespace flexneck::pipeline
