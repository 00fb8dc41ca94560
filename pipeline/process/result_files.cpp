// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/process/result_files.h"

#include <array>

#include "geometry/foundation/content_hash.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/hdf5_file.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

struct Kind {
  std::string_view format;
  void (*copy)(const fs::path& from, const fs::path& to);
};

constexpr std::array<Kind, 4> kKinds = {
    {{mesher::kMeshFormat.name,
      [](const fs::path& from, const fs::path& to) {
        mesher::write_mesh(to, mesher::read_mesh(from));
      }},
     {fe_modal::kModalBodyFormat.name,
      [](const fs::path& from, const fs::path& to) {
        fe_modal::write_modal_body(to, fe_modal::read_modal_body(from));
      }},
     {fe_modal::kStaticSolutionFormat.name,
      [](const fs::path& from, const fs::path& to) {
        fe_modal::write_static_solution(to, fe_modal::read_static_solution(from));
      }},
     {multibody::kHistoryFormat.name, [](const fs::path& from, const fs::path& to) {
        multibody::write_history(to, multibody::read_history(from));
      }}}};

/// True if this process may read the file: the readers refuse a path that is not a file, and a
/// content that does not match its hash, before HDF5 sees it.
bool is_safe(const fs::path& path) {
  std::error_code none;
  return !fs::is_regular_file(path, none) || carried_hash(path).has_value();
}

}  // namespace

ReadableFile::ReadableFile(const fs::path& path, std::string_view format) : path_(path) {
  if (is_safe(path)) return;
  folder_.emplace();
  path_ = *folder_ / "copy.h5";
  const std::uint64_t size = fs::file_size(path);
  IsolatedTask task;
  task.name = "copy";
  task.arguments = {path.string(), path_.string(), std::string(format)};
  task.limits = {.memory_bytes = (768U << 20U) + 16 * size,
                 .processor_s = static_cast<unsigned>(10 + (size >> 20U)),
                 .clock_s = static_cast<unsigned>(20 * (10 + (size >> 20U)))};
  task.file = path;
  task.library = "HDF5";
  task.advice = "it is damaged; make it again";
  run_isolated(task, folder_->path(), {});
}

void copy_task(const std::vector<std::string>& arguments, const ChildLines& /*lines*/) {
  const fs::path& from = arguments.at(0);
  const std::string format = arguments.at(2).empty() ? format_of(from) : arguments.at(2);
  for (const Kind& kind : kKinds) {
    if (kind.format == format) kind.copy(from, arguments.at(1));
  }
}

mesher::MeshFile read_mesh(const fs::path& path) {
  return mesher::read_mesh(ReadableFile(path, mesher::kMeshFormat.name).path());
}

fe_modal::ModalBodyFile read_modal_body(const fs::path& path) {
  return fe_modal::read_modal_body(ReadableFile(path, fe_modal::kModalBodyFormat.name).path());
}

fe_modal::StaticSolutionFile read_static_solution(const fs::path& path) {
  return fe_modal::read_static_solution(
      ReadableFile(path, fe_modal::kStaticSolutionFormat.name).path());
}

multibody::HistoryFile read_history(const fs::path& path) {
  return multibody::read_history(ReadableFile(path, multibody::kHistoryFormat.name).path());
}

void require_whole_run(const fs::path& path, const multibody::History& history) {
  if (history.incomplete.empty()) return;
  throw ComputationError(
      path.string() +
      ": the run ended early; the results up to that time are kept: " + history.incomplete);
}

}  // namespace flexneck::pipeline
