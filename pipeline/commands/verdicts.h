// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipeline/commands/commands.h"

namespace flexneck::pipeline {

/// Judges the study's tests by the runs of their cases, shows the verdicts and writes
/// verdicts.json. A case that has not been run is told.
/// @throws InputError if a run stems from other values or is incomplete.
void write_verdicts(const CommandInput& input);

/// Whether a study has tests of regulations or with measured data.
bool has_tests(const Study& study);

}  // namespace flexneck::pipeline
