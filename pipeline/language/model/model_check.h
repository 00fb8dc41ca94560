// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipeline/language/model/model_sections.h"

namespace flexneck::pipeline {

/// Checks the connections of bodies.
/// @throws InputError for a rigid body that fixed joints couple to two prescribed ones.
void check_connections(const Assembly& assembly);

}  // namespace flexneck::pipeline
