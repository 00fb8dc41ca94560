// SPDX-License-Identifier: GPL-3.0-or-later
// The command, with a minimum step larger than the motion needs.
#include <filesystem>

#include <catch2/catch.hpp>

#include "geometry/foundation/temporary_folder.h"
#include "multibody/files/history_file.h"
#include "tests/support/coarse_neck.h"
#include "tests/support/flexneck_command.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using testing::CommandOutcome;

namespace {

namespace fs = std::filesystem;

constexpr const char* kLargeSteps = " --set 'solver.min_step=0.3 ms'";

CommandOutcome run_coarse(const fs::path& folder, const std::string& arguments) {
  return testing::run_flexneck(arguments + " -q -o " + folder.string() + testing::kCoarseNeck);
}

}  // namespace

TEST_CASE(
    "a case that ends early leaves what there is of it, and nothing takes it for a whole run") {
  const TemporaryFolder folder;
  REQUIRE(run_coarse(folder.path(), "mesh").exit_code == 0);
  REQUIRE(run_coarse(folder.path(), "modes").exit_code == 0);
  const std::string early = "the run ended early; the results up to that time are kept: ";

  const CommandOutcome pendulum = run_coarse(folder.path(), std::string("pendulum") + kLargeSteps);
  INFO(pendulum.text);
  CHECK(pendulum.exit_code == 3);
  CHECK_THAT(pendulum.text, Contains("pendulum-flexion-20.h5: " + early));
  const auto file = multibody::read_history(folder / "pendulum-flexion-20.h5");
  CHECK_FALSE(file.history.incomplete.empty());
  REQUIRE(file.history.time_s.size() > 0);
  CHECK(file.channels.at(0).values.cols() == file.history.time_s.size());
  CHECK_FALSE(fs::exists(folder / "pendulum.json"));

  // The linear neck bends further than its modes are valid for, and every file says so.
  const CommandOutcome tester = run_coarse(folder.path(), "static");
  REQUIRE(tester.exit_code == 0);
  CHECK_THAT(tester.text, Contains("Warning: flexion: body 'neck' "));
  CHECK(multibody::read_history(folder / "static-flexion.h5").history.warnings.size() == 1);

  const CommandOutcome verify = run_coarse(folder.path(), std::string("verify") + kLargeSteps);
  INFO(verify.text);
  CHECK(verify.exit_code == 3);
  CHECK_THAT(verify.text, Contains(early));
}
