// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/cli/info_folder.h"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/hdf5_file.h"
#include "pipeline/experiments/verification/verification.h"
#include "pipeline/process/result_files.h"
#include "pipeline/process/text_table.h"
#include "pipeline/results/report/results.h"
#include "pipeline/run/remembered_study.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

/// File extension that tells the format, and a description of such a file.
struct Ending {
  std::string_view ending, what;
};
constexpr std::array<Ending, 7> kEndings = {{{".csv", "curves or a table as text"},
                                             {".html", "page for a browser"},
                                             {".json", "tables"},
                                             {".png", "picture"},
                                             {".svg", "picture"},
                                             {".xdmf", "for ParaView"},
                                             {".toml", "study or model"}}};

/// Description of a file; empty for a file of another program.
std::string what_is(const fs::path& path) {
  if (path.extension() == ".h5") {
    try {
      return format_of(ReadableFile(path).path());
    } catch (const InputError&) {
      return "damaged, or of another program";
    }
  }
  for (const Ending& each : kEndings)
    if (path.extension() == each.ending) return std::string(each.what);
  return {};
}

/// Files that share one row: "pendulum-*.h5" for the files of many cases.
struct Group {
  std::vector<fs::path> files;
  std::uintmax_t bytes = 0;
};

std::map<std::string, Group> groups_in(const fs::path& folder) {
  std::map<std::string, Group> groups;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path& path = entry.path();
    if (!entry.is_regular_file() || path.filename().string().starts_with('.')) continue;
    const std::string stem = path.stem().string();
    const std::size_t dash = stem.find('-');
    const std::string name = dash == std::string::npos
                                 ? path.filename().string()
                                 : stem.substr(0, dash) + "-*" + path.extension().string();
    Group& group = groups[name];
    group.files.push_back(path);
    group.bytes += entry.file_size();
  }
  return groups;
}

std::string verdict_of(const fs::path& file) {
  if (!fs::is_regular_file(file)) return {};
  const VerificationTable table = read_verification(file).table;
  const auto count = [&](VerificationRow::Status status) {
    return std::count_if(table.rows.begin(), table.rows.end(),
                         [&](const VerificationRow& row) { return row.status == status; });
  };
  const auto passed = count(VerificationRow::Status::passed);
  const auto judged = passed + count(VerificationRow::Status::failed);
  return judged == 0 ? "\nVerification: nothing is judged"
                     : fmt::format("\nVerification against {} figures: {} of {} agree",
                                   table.reference_origins, passed, judged);
}

}  // namespace

std::string folder_text(const fs::path& folder) {
  std::vector<std::vector<std::string>> rows = {{"file", "what it is", "number", "KiB"}};
  bool is_ours = false;
  for (const auto& [name, group] : groups_in(folder)) {
    const std::string what = what_is(group.files.front());
    is_ours = is_ours || what.starts_with("flexneck ");
    const bool is_one = group.files.size() == 1;
    rows.push_back({is_one ? group.files.front().filename().string() : name, what,
                    std::to_string(group.files.size()),
                    std::to_string((group.bytes + 1023) / 1024)});
  }
  const std::optional<StudyChoice> choice = remembered_study(folder);
  if (!is_ours && !choice)
    throw InputError(folder.string() +
                     ": expected a folder of results, found none of flexneck's files in it; "
                     "'flexneck run -o " +
                     folder.string() + "' makes them");
  std::sort(rows.begin() + 1, rows.end(),
            [](const auto& a, const auto& b) { return comes_before(a.front(), b.front()); });
  return folder.string() + ": " +
         (choice ? "results of the study " + text_of(*choice) : "results of models") +
         verdict_of(folder / "verification.json") + "\n" + text_table(rows, {0, 1}) +
         "\n'flexneck info " + (folder / "FILE").string() + "' describes one of them";
}

}  // namespace flexneck::pipeline
