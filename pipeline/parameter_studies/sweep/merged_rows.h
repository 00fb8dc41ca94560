// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/parameter_studies/sampling/row_file.h"

namespace flexneck::pipeline {

/// Part `index` of `count` of a sweep's rows, from 1: adjacent rows, which share stages.
struct Shard {
  std::uint64_t index = 1;
  std::uint64_t count = 1;

  std::uint64_t first(std::uint64_t rows) const { return rows * (index - 1) / count; }
  std::uint64_t end(std::uint64_t rows) const { return rows * index / count; }
  /// Name such as "2-of-8".
  std::string name() const { return std::to_string(index) + "-of-" + std::to_string(count); }
};

/// Folder and file of a shard's rows: <folder>/sweep-shards/2-of-8/rows.txt.
std::filesystem::path folder_of_shard(const std::filesystem::path& results, const Shard& shard);
std::filesystem::path rows_of_shard(const std::filesystem::path& results, const Shard& shard);

/// Files of all existing shards, of any definition and division.
std::vector<std::filesystem::path> row_files(const std::filesystem::path& results);

/// Merges the rows of several files, ascending, each once.
class MergedRows {
 public:
  MergedRows(const std::vector<std::filesystem::path>& files, const RowFormat& format);

  /// Reads the next row. @return false at the end
  bool next(RowResult& result);

 private:
  struct Source {
    std::unique_ptr<RowReader> reader;
    RowResult first;  ///< next row, not passed on yet
    bool has_first = false;
  };
  std::vector<Source> sources_;
};

}  // namespace flexneck::pipeline
