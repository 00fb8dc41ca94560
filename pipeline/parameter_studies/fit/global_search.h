// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>

#include <Eigen/Core>

#include "pipeline/parameter_studies/fit/fit_objective.h"

namespace flexneck::pipeline {

/// Settings of a search over the whole unit cube.
struct GlobalSearch {
  int evaluations = 1000;  ///< maximum number of model evaluations
  unsigned long seed = 1;
  const std::atomic<bool>* is_stopped = nullptr;  ///< set by the user; null: never
};

/// The best place found by controlled random search with local mutation (Kaelo and Ali, J. Optim.
/// Theory Appl. 130 (2006) 253, in NLopt GN_CRS2_LM), from a population that contains the start and
/// Sobol' points. It ends when the population has shrunk to a thousandth of the cube, or at the
/// maximum number of evaluations. Places at which the model fails rank last. The result depends on
/// start and seed alone; least_squares() refines it.
/// @param values  evaluates the model: observables without slopes
/// @throws FitStopped
Eigen::VectorXd best_of_search(const FitObjective& objective,
                               const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& values,
                               const Eigen::VectorXd& start, const GlobalSearch& search);

}  // namespace flexneck::pipeline
