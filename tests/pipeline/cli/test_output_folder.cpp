// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <string>
#include <sys/file.h>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/foundation/file_descriptor.h"
#include "geometry/foundation/temporary_folder.h"
#include "tests/support/coarse_neck.h"
#include "tests/support/files.h"
#include "tests/support/flexneck_command.h"

using namespace flexneck;
using testing::check_refused;
using testing::CommandOutcome;
using testing::names_in;
using testing::run_flexneck;

namespace fs = std::filesystem;

TEST_CASE("a folder that cannot be made or written is refused") {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "in the way";
  check_refused(
      run_flexneck("mesh -o " + (folder / "file").string() + testing::kCoarseNeck + " -q"),
      "the folder for results cannot be created");
  // Not even root can create a file there.
  check_refused(run_flexneck(std::string("mesh -q -o /proc/self") + testing::kCoarseNeck),
                "/proc/self: cannot be written");
}

TEST_CASE("one command at a time writes into a folder, and the second is told which") {
  const TemporaryFolder folder;
  const std::string out = " -o " + folder.path().string();
  const fs::path path = folder / ".flexneck.lock";
  {
    std::ofstream(path) << "'flexneck run', process 7 on host";
    const FileDescriptor lock(::open(path.c_str(), O_RDWR | O_CLOEXEC));
    REQUIRE(::flock(lock.get(), LOCK_EX | LOCK_NB) == 0);
    for (const char* const command : {"run", "mesh", "verify", "report", "simulate none.toml"})
      check_refused(run_flexneck(command + out),
                    folder.path().string() + ": is in use by 'flexneck run', process 7 on host");
    // Commands that only read are not blocked.
    CHECK(run_flexneck("study" + out).exit_code == 0);
    CHECK(run_flexneck("mesh --show" + out).exit_code == 0);
    CHECK(names_in(folder.path()).size() == 1);
  }
  // The lock of an ended process blocks nobody.
  check_refused(run_flexneck("verify" + out), "modes.h5: no such file");
  CHECK(names_in(folder.path()).empty());
  // A command that makes no results leaves no folder.
  check_refused(run_flexneck("verify" + out + "/new"), "modes.h5: no such file");
  CHECK(names_in(folder.path()).empty());
}

TEST_CASE("a folder whose lock cannot be written is left as it was") {
  const TemporaryFolder folder;
  for (const std::string out : {"", "/new"}) {
    const CommandOutcome outcome =
        testing::run_shell("(ulimit -f 0; " + testing::flexneck_program() + " verify -q -o " +
                           folder.path().string() + out + ")");
    check_refused(outcome, "cannot be written (File too large)");
    CHECK(names_in(folder.path()).empty());
  }
}
