// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipeline/model/model_file.h"
#include "pipeline/model/model_sections.h"

namespace flexneck::pipeline {

/// Where a model says twice how it starts, both must say the same: joints' distances, angles and
/// their rates beside bodies' poses and velocities or other joints, and velocities beside a start
/// at rest. Differences of rounding, 1e-6, are none.
/// @param assembly  with its bodies placed and moving
/// @throws InputError naming both keys and their values.
void check_starts(const Assembly& assembly, ModelFile::Start start, ModelFile::Analysis analysis);

}  // namespace flexneck::pipeline
