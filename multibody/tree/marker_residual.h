// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/model/joint_check.h"
#include "multibody/model/model.h"
#include "multibody/model/motion_state.h"

namespace flexneck::multibody::tree {

/// Squares of the residuals of a joint's constraints, and of their rates, from the motion of its
/// markers alone: joint coordinates satisfy the joints by construction, and this checks it.
struct SquaredResidual {
  SquaredResidual(const Joint& joint, const MarkerState& i, const MarkerState& j);

  Violation position, velocity;

 private:
  void add_advance(const Joint& joint, const MarkerState& i, const MarkerState& j);
};

}  // namespace flexneck::multibody::tree
