// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "multibody/descriptor/system.h"
#include "multibody/equations/equations.h"

namespace flexneck::multibody {

/// The velocities of each free body, coupled with those of all that joints or force elements tie to
/// it.
std::vector<Equations::VelocityBlock> coupled_bodies(const System& system, const ForceSet& forces);

}  // namespace flexneck::multibody
