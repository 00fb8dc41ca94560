// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>

#include <catch2/catch.hpp>

#include "geometry/foundation/build_id.h"
#include "tests/support/run_command.h"

using namespace flexneck;

TEST_CASE("the build id is the one that readelf finds in the program") {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  const testing::CommandOutcome notes = testing::run_shell("readelf -n " + program);
  REQUIRE(notes.exit_code == 0);
  CHECK(build_id().size() == 40);
  CHECK_THAT(notes.text, Catch::Matchers::Contains("Build ID: " + build_id()));
}
