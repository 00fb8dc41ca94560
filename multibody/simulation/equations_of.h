// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "multibody/equations/equations.h"
#include "multibody/model/model.h"

namespace flexneck::multibody {

/// Checks a model and options.
/// @throws InputError for a model that is not sound, options that make no sense.
void check_start(const Model& model, const SolverOptions& solver);

/// The equations of a sound model in the formulation of the options. The model must outlive them.
std::unique_ptr<Equations> equations_of(const Model& model, const SolverOptions& solver,
                                        Drive drive = Drive::prescribed);

/// Checks that no prescribed body rotates: bodies on it would be pulled outwards and have no static
/// equilibrium.
/// @throws InputError naming a prescribed body that rotates at time zero.
void check_nothing_turns(const Model& model);

}  // namespace flexneck::multibody
