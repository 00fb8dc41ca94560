// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "geometry/foundation/hdf5_file.h"
#include "geometry/foundation/provenance.h"
#include "pipeline/parameter_studies/sweep/merged_rows.h"
#include "pipeline/parameter_studies/sweep/sweep_rows.h"

namespace flexneck::pipeline {

inline constexpr FileFormat kSweepFormat = {"flexneck sweep", 1, "flexneck sweep"};

/// An output and its SI unit.
struct OutputColumn {
  std::string name;
  std::string unit;
};

/// A curve with the same times in all rows.
struct CurveColumn {
  std::string name;
  std::string unit;
  Eigen::VectorXd time_s;
};

/// Data of a table that has been written.
struct SweepTable {
  Eigen::MatrixXd figures;  ///< (outputs, rows), SI; NaN where there is no value
  std::uint64_t failed = 0;
  /// Number of failed rows by reason, for the first kMaxReasons reasons.
  std::map<std::string, std::uint64_t> reasons;
  static constexpr std::size_t kMaxReasons = 1000;
};

/// Writes the table of all rows: a line of text each, and the same columns as datasets
/// /inputs/<name>, /outputs/<name>, and /failed/rows with /failed/problems. For a parameter with
/// texts the CSV has the text, the dataset its index in the attribute "texts", whose texts are
/// joined by line breaks.
/// @param rows  rows of the whole sweep
/// @throws InputError or ComputationError if a file cannot be written; existing files remain then.
SweepTable write_sweep_table(const std::filesystem::path& csv, const std::filesystem::path& hdf5,
                             const SweepRows& sweep, const std::vector<OutputColumn>& outputs,
                             MergedRows& rows, const Provenance& provenance);

/// Probabilities of the percentile bands.
inline constexpr double kBandShares[] = {0.05, 0.25, 0.5, 0.75, 0.95};

/// For each curve, the percentiles of all rows that have it at each of its times, (5, times).
/// @param rows  starts a new reading of all rows; called as often as memory requires
std::vector<Eigen::MatrixXd> percentile_bands(const std::vector<CurveColumn>& curves,
                                              const std::function<MergedRows()>& rows,
                                              std::uint64_t row_count);

}  // namespace flexneck::pipeline
