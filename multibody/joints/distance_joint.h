// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/joints/joint.h"

namespace flexneck::multibody {

/// A massless rod with a spherical joint at each end. It constrains too little for a tree.
inline constexpr JointKind kDistanceJoint{.name = "distance",
                                          .translation = TranslationConstraint::distance,
                                          .length = {.key = "length", .value = &Joint::length_m}};

}  // namespace flexneck::multibody
