// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "multibody/model/model.h"
#include "tests/support/point_mass_body.h"
#include "tests/support/test_models.h"

namespace flexneck::testing {

multibody::RigidBody random_rigid_body(RandomNumbers& random);

/// Every kind of force, between and across the trees of forest().
void add_forces(ModelBuilder& build, RandomNumbers& random);

/// A forest with every kind of joint between rigid, deformable and prescribed bodies: branches,
/// joints given from either end, deformable bodies that hang on nodes that move, a floating root, a
/// free joint, forces. Where the bodies are at the start is left open.
/// @param stiffens  whether the deformable bodies have stress stiffening
multibody::Model forest(bool stiffens = false);

/// A chain on a prescribed body that turns, with every kind of joint that leaves a motion, each
/// given once from its inner and once from its outer end.
multibody::Model chain_of_all_joints();

}  // namespace flexneck::testing
