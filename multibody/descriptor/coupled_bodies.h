// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "multibody/descriptor/system.h"
#include "multibody/equations/equations.h"

namespace flexneck::multibody {

/// The velocity block of each free body, with the blocks of all bodies that joints or force
/// elements couple with it.
std::vector<Equations::VelocityBlock> coupled_bodies(const System& system, const ForceSet& forces);

}  // namespace flexneck::multibody
