// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipeline/cli/command_line.h"
#include "pipeline/process/console.h"

namespace flexneck::pipeline {

/// Executes a command line: reads the study that it names or that its folder remembers, locks the
/// folder for this command, runs the command, and makes the folder remember the study.
/// @param ranks  the ranks that mpirun has started
/// @return true unless a verification failed
/// @throws InputError, ComputationError as the command does.
/// @pre line.command
bool execute(const CommandLine& line, const Console& console, const fe_modal::Ranks& ranks = {});

}  // namespace flexneck::pipeline
