// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <spawn.h>
#include <sys/types.h>

namespace flexneck::pipeline {

/// File actions and attributes of a new process before it becomes another program, for
/// posix_spawn(): it receives the signals that this process blocks (signal_cleanup.h). All members
/// throw ComputationError if memory runs out.
class SpawnActions {
 public:
  SpawnActions();
  ~SpawnActions();
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;

  void enter(const std::filesystem::path& folder);
  void open(int as, const char* path, int flags, mode_t mode = 0);
  void duplicate(int file, int as);
  void close_from(int first);

  const posix_spawn_file_actions_t* get() const { return &actions_; }
  const posix_spawnattr_t* attributes() const { return &attributes_; }

 private:
  static void require(int code);

  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

}  // namespace flexneck::pipeline
