// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/joints/joint_kind.h"

namespace flexneck::multibody {

/// A joint that constrains nothing: its bodies move as if it were not there, and it transmits no
/// load.
inline constexpr JointKind kFreeJoint{.name = "free"};

}  // namespace flexneck::multibody
