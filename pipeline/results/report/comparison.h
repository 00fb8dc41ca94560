// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/results/report/results.h"

namespace flexneck::pipeline {

/// Results of one of the compared studies.
struct ComparedStudy {
  std::string label;  ///< name of the folder
  Results results;
  Study study = {};  ///< study that made the results, for the scene; empty if unknown
  /// Folder whose picture of the mesh is shown if no motion can be.
  std::filesystem::path folder = {};
};

/// Tables of the comparison: inputs that differ, verification, frequencies of the modes, and every
/// table that at least two of the studies have, with the studies' rows below one another.
std::vector<ResultTable> compared_tables(const std::vector<ComparedStudy>& studies);

/// Writes one page with these tables, the curves and the motion of all studies. Other studies'
/// curves are shown as variants of the first one's cases.
/// @throws InputError if a required package is not installed, or the file cannot be written.
void write_comparison(const std::filesystem::path& path, const std::vector<ComparedStudy>& studies);

}  // namespace flexneck::pipeline
