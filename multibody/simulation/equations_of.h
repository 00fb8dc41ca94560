// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "multibody/equations/equations.h"
#include "multibody/model/model.h"

namespace flexneck::multibody {

/// @throws InputError for a model that is not sound, options that make no sense.
void check_start(const Model& model, const SolverOptions& solver);

/// The equations of a sound model in the formulation that the options say. It must outlive them.
std::unique_ptr<Equations> equations_of(const Model& model, const SolverOptions& solver,
                                        Drive drive = Drive::prescribed);

/// Bodies on one that turns would be pulled outwards: they have no static equilibrium.
/// @throws InputError naming a prescribed body that turns at time zero.
void check_nothing_turns(const Model& model);

}  // namespace flexneck::multibody
