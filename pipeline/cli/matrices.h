// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipeline/cli/commands.h"

namespace flexneck::pipeline {

/// Runs `flexneck modes` for a study with [matrices].
/// @pre input.study.matrices
bool modes_of_matrices(const CommandInput& input);

}  // namespace flexneck::pipeline
