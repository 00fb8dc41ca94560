// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "multibody/equations.h"
#include "multibody/history.h"
#include "multibody/model.h"
#include "multibody/simulation.h"

namespace flexneck::multibody {

/// Integrates from a state at time zero that keeps the joints, and records at the output times.
/// @throws IncompleteRun as simulate().
History integrate(const Model& model, Equations& equations, const Eigen::VectorXd& state,
                  const SolverOptions& solver, const OutputOptions& output);

}  // namespace flexneck::multibody
