// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/model/joint_check.h"
#include "multibody/model/model.h"
#include "multibody/model/motion_state.h"

namespace flexneck::multibody::tree {

/// Squares of by how much two markers miss what their joint holds, and of their rates, from their
/// motion alone: joint coordinates hold the joints by themselves, and this sees that they do.
struct SquaredResidual {
  SquaredResidual(const Joint& joint, const MarkerState& i, const MarkerState& j);

  Violation position, velocity;

 private:
  void add_advance(const Joint& joint, const MarkerState& i, const MarkerState& j);
};

}  // namespace flexneck::multibody::tree
