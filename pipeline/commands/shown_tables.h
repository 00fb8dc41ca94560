// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "pipeline/commands/commands.h"
#include "pipeline/output/result_table.h"
#include "pipeline/verification/verification.h"

namespace flexneck::pipeline {

/// Prints a line for each case; with --verbose all tables as they are.
void show_tables(const CommandInput& input, const std::vector<ResultTable>& tables);

/// Prints the figures that have a verdict, and how many have none; with --verbose all of them.
void show_verification(const CommandInput& input, const VerificationTable& table);

}  // namespace flexneck::pipeline
