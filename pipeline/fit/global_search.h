// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>

#include <Eigen/Core>

#include "pipeline/fit/fit_objective.h"

namespace flexneck::pipeline {

/// How a search over all of the unit cube is made.
struct GlobalSearch {
  int evaluations = 1000;  ///< of the model, at most
  unsigned long seed = 1;
  const std::atomic<bool>* is_stopped = nullptr;  ///< by the user; null: never
};

/// The best place found by controlled random search with local mutation (Kaelo and Ali, J. Optim.
/// Theory Appl. 130 (2006) 253, as NLopt has it: GN_CRS2_LM), from a population that holds the
/// start and Sobol' points. It ends when the population has shrunk to a thousandth of the cube, or
/// with the evaluations. Places at which the model fails are the worst. A function of start and
/// seed alone; least_squares() goes on from it.
/// @param values  of the model: observables without slopes
/// @throws FitStopped
Eigen::VectorXd best_of_search(const FitObjective& objective,
                               const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& values,
                               const Eigen::VectorXd& start, const GlobalSearch& search);

}  // namespace flexneck::pipeline
