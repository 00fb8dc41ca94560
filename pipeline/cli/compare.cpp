// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <optional>

#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "pipeline/cli/commands.h"
#include "pipeline/results/report/comparison.h"
#include "pipeline/run/remembered_study.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

/// Name of the folder, or its whole path if another folder has the same name.
std::string label_of(const fs::path& folder, const std::vector<fs::path>& folders) {
  const auto name = [](const fs::path& path) {
    return fs::weakly_canonical(path).filename().string();
  };
  const auto same = std::count_if(folders.begin(), folders.end(), [&](const fs::path& other) {
    return name(other) == name(folder);
  });
  return same > 1 ? folder.lexically_normal().generic_string() : name(folder);
}

/// The study that made a folder, which gives the scene its bodies; empty if it can no longer be
/// read.
Study study_of(const fs::path& folder) {
  const std::optional<StudyChoice> choice = remembered_study(folder);
  if (!choice) return {};
  try {
    return read_study(choice->study.empty() ? built_in_study() : choice->study, choice->settings);
  } catch (const InputError&) {
    return {};
  }
}

/// Prints the first rows of a table; all rows when verbose.
void show(const Console& console, ResultTable table) {
  constexpr std::size_t kMaxRows = 12;
  const std::size_t rows = table.rows.size();
  if (!console.is_verbose() && rows > kMaxRows) {
    table.rows.resize(kMaxRows);
    table.notes = {"and " + std::to_string(rows - kMaxRows) + " more rows (--verbose)"};
  }
  console.result("\n" + printed(table));
}

}  // namespace

bool compare_command(const FileInput& input) {
  if (input.files.size() < 2) {
    throw InputError(
        "compare: expected at least two folders of results, as in 'flexneck compare out other'");
  }
  for (const fs::path& folder : input.files)
    if (!fs::is_directory(folder)) throw InputError(folder.string() + ": no such folder");
  std::vector<ComparedStudy> studies;
  for (const fs::path& folder : input.files) {
    // Read without a study: a folder is compared as it was made, not with today's values.
    studies.push_back(
        {label_of(folder, input.files), read_results(folder, Study()), study_of(folder), folder});
    const Results& results = studies.back().results;
    if (results.files.empty()) refuse_without_results(folder);
    for (const std::string& warning : results.warnings)
      input.console.warning(studies.back().label + ": " + warning);
    if (const std::size_t count = results.run_warnings.size(); count > 0)
      input.console.warning(
          fmt::format("{}: the runs have {} warning{}, which are shown on the page",
                      studies.back().label, count, count == 1 ? "" : "s"));
  }
  input.folder.make();
  const std::vector<ResultTable> tables = compared_tables(studies);
  std::vector<InputFile> files;
  for (const ComparedStudy& study : studies)
    for (const ResultFile& file : study.results.files)
      files.push_back({study.label + "/" + file.name, file.hash});
  write_tables(input.folder.file(kComparisonTables), tables, provenance_of(files, {}));
  write_comparison(input.folder.file("comparison.html"), studies);
  for (std::size_t t = 0; t < std::min<std::size_t>(3, tables.size()); ++t)
    show(input.console, tables[t]);
  input.console.result("\nComparison: " + input.folder.file("comparison.html").string() + ", " +
                       input.folder.file(kComparisonTables).string());
  return true;
}

}  // namespace flexneck::pipeline
