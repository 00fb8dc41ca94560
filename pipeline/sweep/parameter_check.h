// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "pipeline/evaluation/evaluator.h"
#include "pipeline/sweep/sweep_rows.h"

namespace flexneck::pipeline {

/// Reads the study with two values of each parameter, the others as they are.
/// A value that the study refuses is a matter of its rows unless it refuses both.
/// A value that the study refuses is a matter of its rows, unless it refuses both.
/// @throws InputError for a parameter of which it does, or that no output depends on.
void check_parameters(Evaluator& evaluator, const SweepRows& sweep, const WantedOutputs& wanted);

/// Hash of the program and of all that rows are computed from: every value of the study, [sweep]
/// included, and every file it names.
std::string definition_of(const Study& study);

}  // namespace flexneck::pipeline
