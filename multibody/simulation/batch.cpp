// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/simulation/batch.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <utility>

#include "geometry/foundation/error.h"
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
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t k = next++; k < runs.size(); k = next++) results[k] = result_of(runs[k]);
  };
  std::vector<std::jthread> helpers;
  const std::size_t most = std::min<std::size_t>(threads, runs.size());
  for (std::size_t k = 1; k < most; ++k) helpers.emplace_back(work);
  work();
  helpers.clear();  // joins them
  return results;
}

}  // namespace flexneck::multibody
