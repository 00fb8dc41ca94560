// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "multibody/model/model.h"

namespace flexneck::multibody {

// Rigid bodies may lack inertia about axes through their centre of mass: point masses, thin rods.
// Joints have to hold such a rotation. A moment counts as none up to 1e-13 m l^2, rounding of what
// the body's inertia is about its joints, with l the largest distance of its centre of mass from
// its origin and its joints.

/// The inertia about the centre of mass with moments that are none raised to that bound: changes
/// nothing that moves, and leaves a mass matrix that can be factorised. Others stay as they are.
/// @param body    index of a rigid body
/// @param size_m  the model's, which counts for l where that is zero
Eigen::Matrix3d raised_inertia(const Model& model, std::size_t body, double size_m);

/// @throws InputError naming a body and an axis about which it has no inertia and no joint holds
/// it, where the bodies are at the start: its equations of motion are singular.
void check_massless_rotations(const Model& model);

}  // namespace flexneck::multibody
