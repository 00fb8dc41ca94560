// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/foundation/progress.h"
#include "pipeline/evaluation/evaluator.h"
#include "pipeline/sweep/merged_rows.h"
#include "pipeline/sweep/sweep_rows.h"
#include "pipeline/sweep/sweep_table.h"

namespace flexneck::pipeline {

/// How the rows of a sweep are shared out.
struct SweepShare {
  std::optional<Shard> shard;  ///< none: all rows that no shard has left behind
  unsigned threads = 1;
  const std::atomic<bool>* is_stopped = nullptr;  ///< by the user; null: never
};

/// The rows of a sweep in a folder of results: which are there, which are due, and how they are
/// computed. A row that fails is recorded with the reason. What is there stays however the process
/// ends, and the table is the same whoever has computed its rows.
class SweepJob {
 public:
  /// Finds the outputs, and the times of curves by the base study's own.
  /// @param evaluator, sweep  outlive this
  /// @throws InputError as Evaluator::wanted(), Evaluator::require_produced() and
  /// check_varied() do.
  SweepJob(Evaluator& evaluator, const SweepRows& sweep, std::filesystem::path results);

  /// Computes the rows that are due. @param tell takes a line now and then about what is left
  /// @return whether all were done, none stopped
  /// @throws ComputationError if they cannot be written.
  bool compute(const SweepShare& share, const Progress& tell);

  /// Whether all rows of the sweep are there.
  bool is_complete() const;
  /// Names the files of rows that do not count, since what they were made from is another by now, a
  /// line each; for a shard, those of other studies beside it, too.
  std::vector<std::string> outdated(const Shard& shard) const;
  /// The files that the rows are made from, once all are there.
  std::vector<FileRead> files() const { return format_.files->files(); }
  /// How many rows of a range are there.
  std::uint64_t rows_done(const Shard& shard) const;

  MergedRows rows() const { return {row_files(results_), format_}; }
  const std::vector<OutputColumn>& figures() const { return figures_; }
  const std::vector<CurveColumn>& curves() const { return curves_; }

 private:
  void find_curves();
  RowResult computed(std::uint64_t row);
  void add_curves(const Evaluation& evaluation, RowResult& result) const;
  std::vector<bool> rows_in(const std::vector<std::filesystem::path>& files) const;

  Evaluator& evaluator_;
  const SweepRows& sweep_;
  std::filesystem::path results_;
  WantedOutputs wanted_;
  std::vector<OutputColumn> figures_;
  std::vector<CurveColumn> curves_;
  RowFormat format_;
};

}  // namespace flexneck::pipeline
