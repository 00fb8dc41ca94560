// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "multibody/model/model.h"
#include "tests/support/point_mass_body.h"
#include "tests/support/test_models.h"

namespace flexneck::testing {

multibody::RigidBody random_rigid_body(RandomNumbers& random);

/// Adds every kind of force, between and across the trees of forest().
void add_forces(ModelBuilder& build, RandomNumbers& random);

/// A forest with every kind of joint between rigid, deformable and prescribed bodies: branches,
/// joints defined from either end, deformable bodies on moving nodes, a floating root, a free
/// joint, forces. The bodies' initial state is left open.
/// @param stiffens  true if the deformable bodies have stress stiffening
multibody::Model forest(bool stiffens = false);

/// A chain on a rotating prescribed body, with every kind of joint that leaves a motion, each
/// defined once from its inner and once from its outer end.
multibody::Model chain_of_all_joints();

}  // namespace flexneck::testing
