// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "pipeline/cli/commands.h"
#include "pipeline/experiments/verification/verification.h"
#include "pipeline/process/result_table.h"

namespace flexneck::pipeline {

/// Prints a line for each case; with --verbose all tables in full.
void show_tables(const CommandInput& input, const std::vector<ResultTable>& tables);

/// Prints the figures that have a verdict, and the number of those without; with --verbose all
/// figures.
void show_verification(const CommandInput& input, const VerificationTable& table);

}  // namespace flexneck::pipeline
