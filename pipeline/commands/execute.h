// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipeline/commands/command_line.h"
#include "pipeline/console/console.h"

namespace flexneck::pipeline {

/// Does what a command line asks for: reads the study that it names or that its folder remembers,
/// keeps the folder for this command alone, runs the command, and has the folder remember.
/// @param ranks  that mpirun has started
/// @return whether no verification failed
/// @throws InputError, ComputationError as the command does.
/// @pre line.command
bool execute(const CommandLine& line, const Console& console, const fe_modal::Ranks& ranks = {});

}  // namespace flexneck::pipeline
