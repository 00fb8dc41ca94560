// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "multibody/descriptor/equations_of_motion.h"
#include "multibody/model/model.h"

namespace flexneck::multibody {

/// The state that the model's bodies are given, as System lays it out.
Eigen::VectorXd given_state(const Model& model, const System& system);

/// Whether velocities matter: a search for an equilibrium has no use for them.
enum class Check { positions, positions_and_velocities };

/// Velocities of all bodies at the start, (6+m) each and none of prescribed ones, in the model's
/// order: those given, and where joints or motors ask for others, of bodies whose velocities are
/// open (Body::velocities_are_open), those nearest in the mass metric that fit. Rates of
/// deformation are always given.
std::vector<Eigen::VectorXd> fitting_velocities(const Model& model);

/// Puts the state at the start of the run onto the joints, velocities that are open first.
/// @throws InputError if a joint is violated by more than rounded input explains: its markers apart
/// by over 1e-6 of the system's size or turned by over 1e-6 rad, or parting faster than 1e-6 of the
/// system's largest speed. The message names the joint.
void join(const Model& model, EquationsOfMotion& equations, Eigen::VectorXd& state, Check check);

/// The positions that the model's bodies are given, put onto the joints at the start.
/// @throws as join().
Eigen::VectorXd given_positions(const Model& model, EquationsOfMotion& equations);

}  // namespace flexneck::multibody
