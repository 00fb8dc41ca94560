// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "multibody/model.h"

namespace flexneck::multibody {

/// How far a joint's markers miss what the joint holds of positions (m or m/s) and of orientations
/// (rad or rad/s).
struct Violation {
  double translation;
  double rotation;
};

/// Rounded input may miss by 1e-6 of the system's size and 1e-6 rad.
/// @param size_m  of the system
/// @throws InputError naming the joint and how far its markers are apart.
void check_positions(const Model& model, std::size_t joint, const Violation& found, double size_m);
/// Or by 1e-6 of the largest speed in the system.
/// @throws InputError naming the joint and how fast its markers part.
void check_velocities(const Model& model, std::size_t joint, const Violation& found, double size_m,
                      double speed_m_s);

/// @throws InputError: a body that hangs on no driven one has no equilibrium.
[[noreturn]] void refuse_floating_body(const std::string& body);

}  // namespace flexneck::multibody
