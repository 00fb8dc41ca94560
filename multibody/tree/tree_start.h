// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "multibody/model/motion_state.h"
#include "multibody/tree/tree.h"

namespace flexneck::multibody::tree {

/// The state whose joints are nearest to the given poses and velocities of the bodies, at the start
/// of the run.
/// @throws InputError naming a joint that these violate by more than rounding (see joint_check.h).
Eigen::VectorXd given_state(const Tree& tree);
/// The state at the given poses, at rest: given velocities are ignored.
Eigen::VectorXd given_positions(const Tree& tree);
/// The state of a tree whose bodies have the given states, one for each body of the tree; parts
/// that their joints do not permit are left out.
Eigen::VectorXd state_of(const Tree& tree, const std::vector<BodyState>& bodies);

}  // namespace flexneck::multibody::tree
