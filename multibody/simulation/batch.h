// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "multibody/history/history.h"
#include "multibody/model/model.h"
#include "multibody/simulation/simulation.h"

namespace flexneck::multibody {

/// One run of a batch.
struct BatchRun {
  const Model* model;  ///< not null; must outlive the batch; runs may share it
  SolverOptions solver = {};
  OutputOptions output = {};
  bool from_equilibrium = false;  ///< see simulate_from_equilibrium()
};

/// Result of a run of a batch.
struct BatchResult {
  History history;    ///< empty if the run could not start
  std::string error;  ///< reason why it failed or ended early; normally empty
};

/// Runs many models on several threads, each run on one thread. Results are in the order of the
/// runs and identical to the last bit to those of single runs. A run that fails stops no other.
/// @param threads  at least 1; more than there are runs or processors are of no use
/// @throws InputError if `threads` is zero.
std::vector<BatchResult> simulate_batch(const std::vector<BatchRun>& runs, unsigned threads);

}  // namespace flexneck::multibody
