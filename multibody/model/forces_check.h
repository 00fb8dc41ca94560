// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/model/model.h"

namespace flexneck::multibody {

/// Checks names, markers and values of a model's forces, and that a resistance's coordinate is one
/// that its joint leaves free. @throws InputError naming the force.
void check_forces(const Model& model);

}  // namespace flexneck::multibody
