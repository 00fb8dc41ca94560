// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/forces/bushing.h"
#include "multibody/forces/cable.h"
#include "multibody/forces/force_lists.h"
#include "multibody/forces/function_force.h"
#include "multibody/forces/joint_resistance.h"
#include "multibody/forces/line_force.h"
#include "multibody/forces/marker_spring.h"
#include "multibody/forces/point_force.h"
#include "multibody/forces/section.h"
#include "multibody/forces/torque.h"

namespace flexneck::multibody {

/// The force elements of a model, of all kinds. A new kind is a header of its own (ForceElement)
/// and a row here.
using Forces = ForceLists<PointForce,       // [[force]] in model files
                          Torque,           // [[torque]]
                          MarkerSpring,     // [[spring]]
                          Bushing,          // [[bushing]]
                          JointResistance,  // [[resistance]]
                          LineForce,        // [[line_force]]
                          Section,          // [[section]]
                          FunctionForce,    // [[function_force]]
                          Cable>;           // [[cable]]

}  // namespace flexneck::multibody
