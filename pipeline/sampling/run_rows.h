// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>

#include "pipeline/sampling/row_file.h"

namespace flexneck::pipeline {

/// Rows to be computed by several threads.
struct RowRun {
  /// The next row that is due, ascending; none at the end. Called by one thread at a time.
  std::function<std::optional<std::uint64_t>()> next_due;
  /// Computes a row. By any thread; throws nothing but what ends the whole run.
  std::function<RowResult(std::uint64_t row)> compute;
  /// Takes the rows, in their order, on the thread that called run_rows().
  std::function<void(const RowResult&)> take;
  unsigned threads = 1;                           ///< that compute
  const std::atomic<bool>* is_stopped = nullptr;  ///< by the user; null: never
};

/// Computes rows ahead, as many as keep the threads busy, and hands them over in order. Whatever
/// throws ends the run once the rows that are being computed are done.
/// @return whether all were done, none stopped
bool run_rows(const RowRun& run);

}  // namespace flexneck::pipeline
