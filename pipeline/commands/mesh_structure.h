// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipeline/commands/commands.h"

namespace flexneck::pipeline {

/// `flexneck mesh` of a study whose [geometry] is not the neck: from a script or a file.
/// @pre input.study.structure
bool mesh_structure(const CommandInput& input);

}  // namespace flexneck::pipeline
