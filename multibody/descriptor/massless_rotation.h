// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "multibody/model/model.h"

namespace flexneck::multibody {

// Rigid bodies may lack inertia about axes through their centre of mass: point masses, thin rods.
// Joints must constrain such a rotation. A moment counts as zero up to 1e-13 m l^2, the rounding of
// the body's inertia about its joints, with l the largest distance of its centre of mass from its
// origin and its joints.

/// The inertia about the centre of mass with zero moments raised to that bound, which does not
/// affect the motion but makes the mass matrix factorisable. Other moments are unchanged.
/// @param body    index of a rigid body
/// @param size_m  size of the model, used for l if that is zero
Eigen::Matrix3d raised_inertia(const Model& model, std::size_t body, double size_m);

/// Checks that joints constrain every rotation without inertia, with the bodies at their start.
/// @throws InputError naming a body and an axis about which it has no inertia and no joint
/// constrains it: its equations of motion are singular.
void check_massless_rotations(const Model& model);

}  // namespace flexneck::multibody
