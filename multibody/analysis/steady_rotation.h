// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <Eigen/Core>

#include "multibody/descriptor/reduced_dynamics.h"

namespace flexneck::multibody {

/// The frame of prescribed bodies that rotate steadily about one axis fixed in the world; none if
/// no prescribed body rotates at time zero.
/// @throws InputError if prescribed bodies rotate unsteadily or differently, or if gravity or a
/// load makes the motion in that frame depend on time: the message names the cause.
std::optional<TurningFrame> steady_rotation(const Model& model);

/// Positions of the free bodies at rest relative to the frame, where gravity, forces and
/// centrifugal loads balance, whether stable or not. It is the solution to which Newton's method
/// converges from the given positions, which satisfy the joints.
/// @param equations  with Drive::prescribed
/// @throws InputError if a joint or a load between rotating and non-rotating bodies depends on the
/// angle of rotation, so that small motions would have periodic coefficients.
/// @throws ComputationError if none is found, as near a critical speed.
Eigen::VectorXd rotating_positions(EquationsOfMotion& equations, const TurningFrame& frame,
                                   const Eigen::VectorXd& positions);

}  // namespace flexneck::multibody
