// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/foundation/progress.h"
#include "pipeline/parameter_studies/evaluation/evaluator.h"
#include "pipeline/parameter_studies/sweep/merged_rows.h"
#include "pipeline/parameter_studies/sweep/sweep_rows.h"
#include "pipeline/parameter_studies/sweep/sweep_table.h"

namespace flexneck::pipeline {

/// Share of a sweep's rows for one process.
struct SweepShare {
  std::optional<Shard> shard;  ///< none: all rows that shards have not computed
  unsigned threads = 1;
  const std::atomic<bool>* is_stopped = nullptr;  ///< set by the user; null: never
};

/// The rows of a sweep in a folder of results: those that exist, those that are due, and their
/// computation. A row that fails is recorded with the reason. Existing rows remain however the
/// process ends, and the table is the same whoever has computed its rows.
class SweepJob {
 public:
  /// Finds the outputs, and the times of curves by the base study.
  /// @param evaluator, sweep  outlive this
  /// @throws InputError as Evaluator::wanted(), Evaluator::require_produced() and
  /// check_varied() do.
  SweepJob(Evaluator& evaluator, const SweepRows& sweep, std::filesystem::path results);

  /// Computes the rows that are due. @param tell takes a line now and then about the remaining rows
  /// @return true if all were computed, false if the user stopped it
  /// @throws ComputationError if they cannot be written.
  bool compute(const SweepShare& share, const Progress& tell);

  /// True if all rows of the sweep exist.
  bool is_complete() const;
  /// Lists the files of rows that are invalid because their source files have changed, a line each;
  /// for a shard, also files of other studies beside it.
  std::vector<std::string> outdated(const Shard& shard) const;
  /// The files that the rows depend on, once all rows exist.
  std::vector<FileRead> files() const { return format_.files->files(); }
  /// Number of existing rows in a range.
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
