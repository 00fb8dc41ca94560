// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>

#include "pipeline/parameter_studies/sampling/row_file.h"

namespace flexneck::pipeline {

/// Rows to be computed by several threads.
struct RowRun {
  /// Returns the next row that is due, ascending; none at the end. Called by one thread at a time.
  std::function<std::optional<std::uint64_t>()> next_due;
  /// Computes a row. Called by any thread; throws only errors that end the whole run.
  std::function<RowResult(std::uint64_t row)> compute;
  /// Receives the rows, in their order, on the thread that called run_rows().
  std::function<void(const RowResult&)> take;
  unsigned threads = 1;                           ///< number of threads that compute
  const std::atomic<bool>* is_stopped = nullptr;  ///< set by the user; null: never
};

/// Computes rows ahead, as many as keep the threads busy, and passes them on in order. An exception
/// ends the run once the rows being computed are finished.
/// @return true if all were computed, false if the user stopped the run
bool run_rows(const RowRun& run);

}  // namespace flexneck::pipeline
