// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "pipeline/model/assembly.h"

namespace flexneck::pipeline {

/// Where a model says twice how it starts, both must say the same: joints' distances, angles and
/// their rates beside bodies' poses and velocities or other joints, and velocities beside a start
/// at rest. Differences of rounding, 1e-6, are none.
/// @param assembly  with its bodies placed and moving
/// @param rest      what says that the model starts at rest against its prescribed bodies, such as
///                  "[solver] has start = \"equilibrium\""; empty if it may move
/// @throws InputError naming both keys and their values.
void check_starts(const Assembly& assembly, const std::string& rest);

}  // namespace flexneck::pipeline
