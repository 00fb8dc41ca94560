// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "multibody/descriptor/equations_of_motion.h"
#include "multibody/model/model.h"

namespace flexneck::multibody {

/// The initial state of the model's bodies, in the layout of System.
Eigen::VectorXd given_state(const Model& model, const System& system);

/// Scope of the check of joints: a search for an equilibrium does not need velocities.
enum class Check { positions, positions_and_velocities };

/// Velocities of all bodies at the start, (6+m) each and none for prescribed ones, in the model's
/// order: the given ones, except that open velocities (Body::velocities_are_open), where joints or
/// motors demand others, become the nearest in the mass metric that fit. Rates of deformation are
/// always given.
std::vector<Eigen::VectorXd> fitting_velocities(const Model& model);

/// Makes the state at the start of the run satisfy the joints, open velocities first.
/// @throws InputError if a joint is violated by more than rounded input explains: its markers apart
/// by over 1e-6 of the system's size or rotated by over 1e-6 rad, or separating faster than 1e-6 of
/// the system's largest speed. The message names the joint.
void join(const Model& model, EquationsOfMotion& equations, Eigen::VectorXd& state, Check check);

/// The initial positions of the model's bodies, corrected to satisfy the joints at the start.
/// @throws as join().
Eigen::VectorXd given_positions(const Model& model, EquationsOfMotion& equations);

}  // namespace flexneck::multibody
