// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/sweep/merged_rows.h"

#include <algorithm>

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

constexpr const char* kShards = "sweep-shards";
constexpr const char* kRows = "rows.txt";

}  // namespace

fs::path folder_of_shard(const fs::path& results, const Shard& shard) {
  return results / kShards / shard.name();
}

fs::path rows_of_shard(const fs::path& results, const Shard& shard) {
  return folder_of_shard(results, shard) / kRows;
}

std::vector<fs::path> row_files(const fs::path& results) {
  std::vector<fs::path> files;
  std::error_code none;
  for (const fs::directory_entry& each : fs::directory_iterator(results / kShards, none))
    if (fs::is_regular_file(each.path() / kRows)) files.push_back(each.path() / kRows);
  std::sort(files.begin(), files.end());
  return files;
}

MergedRows::MergedRows(const std::vector<fs::path>& files, const RowFormat& format) {
  for (const fs::path& file : files) {
    sources_.emplace_back();
    Source& source = sources_.back();
    source.reader = std::make_unique<RowReader>(file, format);
    source.has_first = source.reader->next(source.first);
  }
}

bool MergedRows::next(RowResult& result) {
  Source* least = nullptr;
  for (Source& each : sources_)
    if (each.has_first && (least == nullptr || each.first.row < least->first.row)) least = &each;
  if (least == nullptr) return false;
  result = least->first;
  for (Source& each : sources_)
    while (each.has_first && each.first.row <= result.row)
      each.has_first = each.reader->next(each.first);
  return true;
}

}  // namespace flexneck::pipeline
