// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>

#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"

namespace flexneck {
namespace {

void put(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

}  // namespace

TEST_CASE("memory is what the machine has, less what control groups of either version take away") {
  const TemporaryFolder root;
  CHECK(std::isinf(available_memory(root.path())));
  put(root / "proc/meminfo", "MemTotal:       32000 kB\nMemAvailable:    8000 kB\n");
  CHECK(available_memory(root.path()) == 8000 * 1024);

  // The limits of a group and of those above it, less the memory it uses except for cached files.
  put(root / "proc/self/cgroup", "0::/batch/job\n");
  put(root / "sys/fs/cgroup/batch/memory.max", "6000000\n");
  put(root / "sys/fs/cgroup/batch/memory.current", "1000000\n");
  put(root / "sys/fs/cgroup/batch/memory.stat", "anon 5\ninactive_file 400000\n");
  put(root / "sys/fs/cgroup/batch/job/memory.max", "max\n");
  CHECK(available_memory(root.path()) == 5400000);

  put(root / "proc/self/cgroup", "4:memory:/docker/a\n0::/\n");
  CHECK(available_memory(root.path()) == 8000 * 1024);
  put(root / "sys/fs/cgroup/memory/docker/a/memory.limit_in_bytes", "3000000\n");
  put(root / "sys/fs/cgroup/memory/docker/a/memory.usage_in_bytes", "3500000\n");
  CHECK(available_memory(root.path()) == 0);
}

TEST_CASE("what does not fit is refused with what it takes and what there is") {
  CHECK_NOTHROW(require_memory("a little", 1e3, "do"));
  CHECK_THROWS_AS(require_memory("a lot", 1e18, "take less"), InputError);
  CHECK_THROWS_WITH(require_memory("a lot", 1e18, "take less"),
                    Catch::StartsWith("a lot needs about 1e+09 GB of memory, ") &&
                        Catch::EndsWith(" are free; take less"));
}

}  // namespace flexneck
