// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "multibody/model.h"

namespace flexneck::pipeline {

/// Where a joint's free motions start: of j against i, along and about its axis.
struct JointStart {
  double distance_m = 0;
  double angle_rad = 0;
  double speed_m_s = 0;
  double rate_rad_s = 0;
};

/// Gives a pose to each body that has none, so that the joints close: walks the joints from the
/// bodies that have one. Deformable bodies have the shape of their offset.
/// @param starts  one for each joint
/// @param posed   of each body
/// @throws InputError naming a body that no joint reaches.
void place_bodies(multibody::Model& model, const std::vector<JointStart>& starts,
                  std::vector<bool> posed);

/// Gives velocities to each body that has none: it moves with the one that it hangs on, and by the
/// joint's rates. A body that hangs on none stays at rest.
/// @param moving  of each body: has velocities already; driven bodies need none
void carry_bodies(multibody::Model& model, const std::vector<JointStart>& starts,
                  std::vector<bool> moving);

}  // namespace flexneck::pipeline
