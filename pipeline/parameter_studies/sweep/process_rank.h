// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "pipeline/parameter_studies/sweep/merged_rows.h"

namespace flexneck::pipeline {

/// Index of this process among those that mpirun or a batch system has started; none if it is
/// alone. Determined without MPI.
std::optional<Shard> shard_of_process();

/// Returns whether all these processes were started by one command line, as far as Open MPI reports
/// it.
bool have_one_command_line();

/// Makes this process run alone under MPI, since shards of a sweep need only each other's files. To
/// be called before any thread begins.
void forget_other_processes();

}  // namespace flexneck::pipeline
