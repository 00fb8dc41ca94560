// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/cli/execute.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "geometry/foundation/atomic_file.h"
#include "geometry/foundation/error.h"
#include "pipeline/exchange/export_formats.h"
#include "pipeline/language/document/shipped_files.h"
#include "pipeline/language/study/file_kind.h"
#include "pipeline/run/folder_lock.h"
#include "pipeline/run/remembered_study.h"

namespace flexneck::pipeline {

using fe_modal::Ranks;

namespace {

bool holds_results(const std::filesystem::path& path) {
  const ResultsFolder folder(path);
  return std::filesystem::exists(folder.mesh()) || std::filesystem::exists(folder.modes());
}

/// Chooses the study; without a named one, a command that continues in a folder takes the folder's.
StudyChoice choose_study(const CommandLine& line, const Console& console) {
  StudyChoice choice;
  if (!line.files.empty()) choice.study = named_file(line.files.front());
  choice.settings = line.settings;
  // The folder remembers its study; an empty name stands for the default study of most commands.
  if (line.files.empty() && line.command->built_in != built_in_study)
    choice.study = line.command->built_in();
  if (line.command->begins || !line.files.empty()) return choice;
  const std::optional<StudyChoice> kept = remembered_study(line.folder);
  if (!kept && holds_results(line.folder))
    throw InputError(line.folder.string() +
                     ": study.json, which records the study of these results, is missing; name the "
                     "study on the command line");
  if (!kept) return choice;
  const StudyChoice given = choice;
  choice = with_settings(*kept, line.settings);
  if (!same(choice, given))
    console.step("Study of " + line.folder.string() + ": " + text_of(choice));
  return choice;
}

Study read_named(const StudyChoice& choice) {
  if (choice.study.empty()) return read_study(built_in_study(), choice.settings);
  try {
    Study study = read_study(choice.study, choice.settings);
    if (!study.structure && !study.matrices) refuse_other_kind(choice.study, FileKind::study);
    return study;
  } catch (const InputError&) {
    refuse_other_kind(choice.study, FileKind::study);
    throw;
  }
}

/// Reads the study on every rank. @throws InputError on all ranks if one cannot read it or reads
/// other values.
Study read_together(const CommandLine& line, const Console& console, const Ranks& ranks,
                    StudyChoice& choice) {
  std::optional<Study> study;
  ranks.together([&] {
    choice = choose_study(line, console);
    study = read_named(choice);
  });
  std::string text;
  for (const std::vector<Parameter>* const list : {&study->parameters, &study->defaults})
    for (const Parameter& each : *list) text += each.key + '\n' + each.value + '\n';
  for (const InputFile& each : study->tables) text += each.name + '\n' + each.hash + '\n';
  const std::uint64_t hash = std::hash<std::string>()(text);
  const std::uint64_t of_first = ranks.of_first(hash);
  ranks.together([&] {
    if (hash != of_first)
      throw InputError(study->file.string() + ": rank " + std::to_string(ranks.own()) +
                       " reads other values than rank 0; use a folder that all ranks share");
  });
  return std::move(*study);
}

/// Remembers the study if the command starts the folder, --keep is given or the folder knows none;
/// otherwise the study and settings hold for this command alone.
void remember(const CommandLine& line, const Console& console, const StudyChoice& choice) {
  const std::optional<StudyChoice> kept = remembered_study(line.folder);
  if (kept && same(*kept, choice)) return;
  if (line.command->begins || line.keep || !kept) {
    remember_study(line.folder, choice);
    return;
  }
  const std::string given = line.files.empty() ? text_of_settings(line.settings) : text_of(choice);
  console.result("\nOnly for this command: " + given +
                 "; add --keep to store it for later commands in " + line.folder.string() +
                 ", too");
}

bool works_on_files(const CommandLine& line) {
  if (line.command->run_on_files == nullptr) return false;
  return line.command->run == nullptr || exports_file(line.files, line.target);
}

/// Runs the command. @param take_lock is called once the arguments are known to be right
bool do_command(const CommandLine& line, const Console& console, Ranks ranks,
                const std::function<void()>& take_lock) {
  const Command& command = *line.command;
  const ResultsFolder folder(line.folder);
  const bool is_first = ranks.is_first();
  if (works_on_files(line)) {
    if (!is_first) return true;
    take_lock();
    return command.run_on_files({{line.files.begin(), line.files.end()},
                                 line.settings,
                                 folder,
                                 console,
                                 line.curves,
                                 line.neck_loads,
                                 line.target,
                                 line.is_binary});
  }
  if (line.files.size() > 1) {
    throw InputError(command.name + ": expected one study, found '" + line.files[1] + "' too");
  }
  StudyChoice choice;
  Study study = read_together(line, console, ranks, choice);
  study.solver.checkpoint = console.checkpoint();
  if (ranks.are_many() && (line.show || !command.uses_ranks)) {
    if (!is_first) return true;
    console.step("Only modes are computed on several ranks; '" + command.name + "' runs on rank 0");
    ranks = {};
  }
  const bool is_remembered = is_first && command.writes_results && command.is_remembered;
  ranks.together([&] {
    if (is_remembered && !line.show) require_rememberable(line.folder, choice);
    if (is_first) take_lock();
  });
  if (line.show) return show_command({study, folder, console});
  const bool passed = command.run({.study = study,
                                   .folder = folder,
                                   .console = console,
                                   .target = line.target,
                                   .is_binary = line.is_binary,
                                   .ranks = ranks,
                                   .redo = line.redo,
                                   .sensitivity = line.sensitivity,
                                   .shares = line.shares});
  if (is_remembered) remember(line, console, choice);
  return passed;
}

}  // namespace

bool execute(const CommandLine& line, const Console& console, const Ranks& ranks) {
  std::optional<FolderLock> lock;
  const auto take_lock = [&] {
    if (!line.locks()) return;
    lock.emplace(line.folder, line.text,
                 [&](const std::string& warning) { console.warning(warning); });
  };
  const bool passed = do_command(line, console, ranks, take_lock);
  if (lock) sync_folder(line.folder);
  return passed;
}

}  // namespace flexneck::pipeline
