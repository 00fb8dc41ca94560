// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "multibody/joints/cylindrical_joint.h"
#include "multibody/joints/distance_joint.h"
#include "multibody/joints/fixed_joint.h"
#include "multibody/joints/free_joint.h"
#include "multibody/joints/planar_joint.h"
#include "multibody/joints/prismatic_joint.h"
#include "multibody/joints/revolute_joint.h"
#include "multibody/joints/screw_joint.h"
#include "multibody/joints/spherical_joint.h"
#include "multibody/joints/universal_joint.h"

namespace flexneck::multibody {

/// All kinds of joints. A new one is a header of its own and a row here.
inline constexpr std::array kJointKinds = {
    &kSphericalJoint, &kRevoluteJoint, &kFixedJoint, &kUniversalJoint, &kCylindricalJoint,
    &kPrismaticJoint, &kPlanarJoint,   &kScrewJoint, &kDistanceJoint,  &kFreeJoint};

}  // namespace flexneck::multibody
