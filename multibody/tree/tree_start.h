// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "multibody/model/motion_state.h"
#include "multibody/tree/tree.h"

namespace flexneck::multibody::tree {

/// The state whose joints come next to the poses and velocities that the bodies are given, at the
/// start of the run.
/// @throws InputError naming a joint that these violate by more than rounding (see joint_check.h).
Eigen::VectorXd given_state(const Tree& tree);
/// The same at rest: velocities are not looked at.
Eigen::VectorXd given_positions(const Tree& tree);
/// The state of a tree whose bodies are as given, one state for each body of the tree; what their
/// joints do not allow is left out.
Eigen::VectorXd state_of(const Tree& tree, const std::vector<BodyState>& bodies);

}  // namespace flexneck::multibody::tree
