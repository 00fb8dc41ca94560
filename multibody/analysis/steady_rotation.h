// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <Eigen/Core>

#include "multibody/descriptor/reduced_dynamics.h"

namespace flexneck::multibody {

/// The frame of prescribed bodies that turn evenly about one axis fixed in the world; none if no
/// prescribed body turns at time zero.
/// @throws InputError if prescribed bodies turn otherwise than evenly and together, or if gravity
/// or a load makes the motion seen from that frame depend on time: the message names what does.
std::optional<TurningFrame> steady_rotation(const Model& model);

/// Positions of the free bodies at rest against the frame: where gravity, forces and centrifugal
/// loads balance, whether stable or not. The solution that Newton's method comes to from the
/// positions given, which are on the joints.
/// @param equations  with Drive::prescribed
/// @throws InputError if a joint or a load between bodies that turn and bodies that do not is not
/// the same all round the axis, so that small motions would have periodic coefficients.
/// @throws ComputationError if none is found, as near a critical speed.
Eigen::VectorXd rotating_positions(EquationsOfMotion& equations, const TurningFrame& frame,
                                   const Eigen::VectorXd& positions);

}  // namespace flexneck::multibody
