// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/report/results.h"

namespace flexneck::pipeline {

/// The results of a study among others.
struct ComparedStudy {
  std::string label;  ///< the folder's name
  Results results;
  Study study = {};  ///< that made it, for the scene; empty if it is not known any more
  std::filesystem::path folder = {};  ///< whose picture of the mesh stands in where no motion can
};

/// What stands side by side: inputs that differ, verification, frequencies of the modes, and every
/// table that at least two of the studies have, its rows by study below one another.
std::vector<ResultTable> compared_tables(const std::vector<ComparedStudy>& studies);

/// Writes one page with these tables, the curves and the motion of all studies. Another study's
/// curves are variants of the first one's cases.
/// @throws InputError if a package that it needs is not installed, or the file cannot be written.
void write_comparison(const std::filesystem::path& path, const std::vector<ComparedStudy>& studies);

}  // namespace flexneck::pipeline
