// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <Eigen/Core>

#include "multibody/descriptor/equations_of_motion.h"
#include "multibody/model/model.h"

namespace flexneck::multibody {

/// Positions of the free bodies at rest relative to the prescribed ones, which are fixed where they
/// are at time zero, under gravity and the forces at time zero: a minimum of the potential energy,
/// sought from the bodies' initial poses.
/// @param equations  with Drive::held
/// @throws InputError as join(), or if a free body is connected to no prescribed one.
/// @throws ComputationError if there is none within reach.
Eigen::VectorXd equilibrium_positions(const Model& model, EquationsOfMotion& equations);

/// As equilibrium_positions() at another time, sought from positions that satisfy the joints then.
/// @param moved  called with the positions after each move; may be empty
Eigen::VectorXd settled_positions(EquationsOfMotion& equations, const Eigen::VectorXd& positions,
                                  double time_s,
                                  const std::function<void(const Eigen::VectorXd&)>& moved = {});

/// Velocities of the free bodies when they move with the prescribed ones at their initial velocity,
/// in the layout of System.
/// @throws InputError if a body is connected to prescribed ones of different velocity, or to none.
Eigen::VectorXd carried_velocities(const Model& model, const System& system);

}  // namespace flexneck::multibody
