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
#include "pipeline/process/isolated_task.h"

namespace flexneck::pipeline {

// HDF5 crashes or hangs on some damaged files. Files of flexneck carry a hash that reveals the
// damage before HDF5 sees them; any other is read by a child process, which writes its content into
// a file of flexneck. All of pipeline/ reads meshes, modes and histories through these functions.

/// @throws InputError as the underlying readers do; in one line if the child dies.
mesher::MeshFile read_mesh(const std::filesystem::path& path);
fe_modal::ModalBodyFile read_modal_body(const std::filesystem::path& path);
fe_modal::StaticSolutionFile read_static_solution(const std::filesystem::path& path);
multibody::HistoryFile read_history(const std::filesystem::path& path);

/// Refuses a run that ended early, of which the file holds the first part only.
/// @throws ComputationError with the reason that the history gives.
void require_whole_run(const std::filesystem::path& path, const multibody::History& history);

/// A file of any of these formats, written by flexneck or copied by a child.
class ReadableFile {
 public:
  /// @param format  the required format; empty: any
  /// @throws InputError as read_mesh() does
  explicit ReadableFile(const std::filesystem::path& path, std::string_view format = {});

  /// File that this process may read; it does not exist if the format is not one of flexneck.
  const std::filesystem::path& path() const { return path_; }

 private:
  std::optional<TemporaryFolder> folder_;
  std::filesystem::path path_;
};

/// Task of the child: takes the file, the copy to be written and the format, which may be empty.
void copy_task(const std::vector<std::string>& arguments, const ChildLines& lines);

}  // namespace flexneck::pipeline
