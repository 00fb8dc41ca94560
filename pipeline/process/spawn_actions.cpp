// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/process/spawn_actions.h"

#include <csignal>
#include <cstring>
#include <string>

#include "geometry/foundation/error.h"

namespace flexneck::pipeline {

void SpawnActions::require(int code) {
  if (code != 0)
    throw ComputationError(std::string("a child process cannot be prepared: ") +
                           std::strerror(code));
}

SpawnActions::SpawnActions() {
  require(posix_spawn_file_actions_init(&actions_));
  require(posix_spawnattr_init(&attributes_));
  sigset_t none;
  sigemptyset(&none);
  require(posix_spawnattr_setsigmask(&attributes_, &none));
  require(posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK));
}

SpawnActions::~SpawnActions() {
  posix_spawnattr_destroy(&attributes_);
  posix_spawn_file_actions_destroy(&actions_);
}

void SpawnActions::enter(const std::filesystem::path& folder) {
  require(posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str()));
}

void SpawnActions::open(int as, const char* path, int flags, mode_t mode) {
  require(posix_spawn_file_actions_addopen(&actions_, as, path, flags, mode));
}

void SpawnActions::duplicate(int file, int as) {
  require(posix_spawn_file_actions_adddup2(&actions_, file, as));
}

void SpawnActions::close_from(int first) {
  require(posix_spawn_file_actions_addclosefrom_np(&actions_, first));
}

}  // namespace flexneck::pipeline
