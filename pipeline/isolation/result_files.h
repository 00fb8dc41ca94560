// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fe_modal/body/modal_body_file.h"
#include "fe_modal/body/static_solution_file.h"
#include "geometry/foundation/temporary_folder.h"
#include "mesher/mesh/mesh_file.h"
#include "multibody/files/history_file.h"
#include "pipeline/isolation/isolated_task.h"

namespace flexneck::pipeline {

// HDF5 crashes or hangs over some damaged files. Those of ours carry a hash that tells the damage
// before HDF5 sees it; any other is read by a child process, which writes what it has found into a
// file of ours. All of pipeline/ reads meshes, modes and histories here.

/// @throws InputError as the readers of the rooms do; in one line if the child dies.
mesher::MeshFile read_mesh(const std::filesystem::path& path);
fe_modal::ModalBodyFile read_modal_body(const std::filesystem::path& path);
fe_modal::StaticSolutionFile read_static_solution(const std::filesystem::path& path);
multibody::HistoryFile read_history(const std::filesystem::path& path);

/// Refuses a run that has ended early, of which the file holds the first part only.
/// @throws ComputationError with the reason that the history gives.
void require_whole_run(const std::filesystem::path& path, const multibody::History& history);

/// A file of any of these formats, of ours or as a child has copied it.
class ReadableFile {
 public:
  /// @param format  that it must have; empty: any
  /// @throws InputError as above
  explicit ReadableFile(const std::filesystem::path& path, std::string_view format = {});

  /// What this process may read; there is no such file if the format is none of ours.
  const std::filesystem::path& path() const { return path_; }

 private:
  std::optional<TemporaryFolder> folder_;
  std::filesystem::path path_;
};

/// The child's part: takes the file, the copy to be written and the format, which may be empty.
void copy_task(const std::vector<std::string>& arguments, const ChildLines& lines);

}  // namespace flexneck::pipeline
