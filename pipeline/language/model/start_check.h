// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "pipeline/language/model/assembly.h"

namespace flexneck::pipeline {

/// Checks that initial values given twice agree: joints' distances, angles and their rates with
/// bodies' poses and velocities or other joints, and velocities with a start at rest. Differences
/// up to 1e-6 count as rounding.
/// @param assembly  with the poses and velocities of its bodies set
/// @param rest      the key by which the model starts at rest relative to its prescribed bodies,
/// such as "[solver] has start = \"equilibrium\""; empty if it may move
/// @throws InputError naming both keys and their values.
void check_starts(const Assembly& assembly, const std::string& rest);

}  // namespace flexneck::pipeline
