// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/simulation/batch.h"

#include <exception>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/in_parallel.h"
#include "multibody/history/incomplete_run.h"

namespace flexneck::multibody {
namespace {

BatchResult result_of(const BatchRun& run) {
  try {
    History history = run.from_equilibrium
                          ? simulate_from_equilibrium(*run.model, run.solver, run.output)
                          : simulate(*run.model, run.solver, run.output);
    return {std::move(history), {}};
  } catch (const IncompleteRun& error) {
    return {error.history, error.what()};
  } catch (const std::exception& error) {
    return {{}, error.what()};
  }
}

}  // namespace

std::vector<BatchResult> simulate_batch(const std::vector<BatchRun>& runs, unsigned threads) {
  if (threads == 0) throw InputError("a batch needs at least one thread");
  std::vector<BatchResult> results(runs.size());
  in_parallel(runs.size(), threads, [&](std::size_t k) { results[k] = result_of(runs[k]); });
  return results;
}

}  // namespace flexneck::multibody
