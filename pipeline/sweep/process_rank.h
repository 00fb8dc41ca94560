// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "pipeline/sweep/merged_rows.h"

namespace flexneck::pipeline {

/// Which of the processes that mpirun or a batch system has started this one is; none if it is
/// alone. Known without MPI.
std::optional<Shard> shard_of_process();

/// Tells whether all these processes were started by one command line, as far as Open MPI tells.
bool have_one_command_line();

/// Has this process forget the others: what uses MPI in it runs alone. Shards of a sweep need
/// nothing of each other but their files. Before any thread begins.
void forget_other_processes();

}  // namespace flexneck::pipeline
