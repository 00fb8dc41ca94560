// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipeline/model/model_sections.h"

namespace flexneck::pipeline {

/// @throws InputError for a rigid body that fixed joints tie to two prescribed ones.
void check_connections(const Assembly& assembly);

}  // namespace flexneck::pipeline
