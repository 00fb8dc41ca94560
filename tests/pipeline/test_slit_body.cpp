// SPDX-License-Identifier: GPL-3.0-or-later
// The slit neck as one deformable body with gaps, beside the plates and sections of the same mesh.
#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "geometry/foundation/temporary_folder.h"
#include "multibody/files/history_file.h"
#include "pipeline/study/study.h"
#include "tests/support/flexneck_command.h"
#include "tests/support/model_text.h"

using Catch::Matchers::Contains;
using namespace flexneck;

namespace {

const std::string kSolver = R"([solver]
analysis = "quasi_static"
end_time = "1 s"
[output]
interval = "1 s"
[[body]]
name = "ground"
kind = "ground"
[[marker]]
body = "ground"
name = "bottom"
position = ["0 m", "0 m", "0 m"]
)";

std::string torque(const std::string& marker, double moment_Nm) {
  return "[[torque]]\nname = \"bend\"\nmarker = \"" + marker +
         "\"\ndirection = [0, 1, 0]\ntimes = [\"0 s\", \"1 s\"]\nmagnitudes = [\"0 N*m\", \"" +
         std::to_string(moment_Nm) + " N*m\"]\n";
}

std::string one_body(double moment_Nm, const std::string& more = "") {
  return kSolver + R"(
[[body]]
name = "neck"
kind = "deformable"
modes_file = "modes.h5"
damping_ratio = 1
)" + more +
         R"(
[[joint]]
name = "clamp"
kind = "fixed"
lower = "ground.bottom"
upper = "neck.base"
)" + torque("neck.top", moment_Nm);
}

std::string plates(double moment_Nm) {
  std::string text = kSolver;
  std::string lower = "ground.bottom";
  std::string base = "base";
  for (int k = 1; k <= 4; ++k) {
    const std::string name = "disc_" + std::to_string(k);
    text += "[[body]]\nname = \"" + name + "\"\nkind = \"rigid\"\nlumped = true\n";
    text += "[[marker]]\nbody = \"" + name +
            "\"\nname = \"face\"\nposition = [\"0 m\", \"0 m\", \"0 m\"]\n";
    text += "[[section]]\nname = \"" + name + "\"\nlower = \"" + lower + "\"\nupper = \"" + name +
            ".face\"\nmodes_file = \"substructure_" + name + ".h5\"\nbase = \"" + base +
            "\"\ntop = \"" + (k == 4 ? "top" : "to_disc_" + std::to_string(k + 1)) + "\"\n";
    lower = name + ".face";
    base = "to_" + name;
  }
  return text + torque("disc_4.face", moment_Nm);
}

/// Rotation about y of a marker at the end of a run.
double rotation(const std::filesystem::path& folder, const std::string& text,
                const std::string& marker) {
  const auto model = testing::write_text(folder / "bend.toml", text);
  const testing::CommandOutcome outcome =
      testing::run_flexneck("simulate " + model.string() + " -q -o " + folder.string());
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
  const auto history = multibody::read_history(folder / "bend.h5").history;
  const auto& at = history.marker(marker).rotation;
  return 2 * std::atan2(at(2, at.cols() - 1), at(0, at.cols() - 1));
}

}  // namespace

TEST_CASE("a slit neck as one body with gaps bends as plates and sections do, both ways") {
  const TemporaryFolder folder;
  const std::string line =
      " " + pipeline::built_in_qualification().string() + " -q -o " + folder.path().string() +
      " --set mesh.quadrant=2 --set mesh.inner_ring=2 --set mesh.rubber_layers=2"
      " --set 'geometry.bolt_patch_radius=0.4 in' --set substructures.slits=openings"
      " --set modes.slits=openings --set modes.basis=residual --set modes.count=4";
  for (const char* const stage : {"mesh", "modes"}) {
    const testing::CommandOutcome outcome = testing::run_flexneck(stage + line);
    INFO(outcome.text);
    REQUIRE(outcome.exit_code == 0);
  }
  constexpr double kSmall_Nm = 0.5;
  const double shut = rotation(folder.path(), one_body(kSmall_Nm), "neck.top");
  const double open = -rotation(folder.path(), one_body(-kSmall_Nm), "neck.top");
  CHECK(open > 1.05 * shut);
  CHECK(shut == Approx(rotation(folder.path(), plates(kSmall_Nm), "disc_4.face")).epsilon(0.005));
  CHECK(open == Approx(-rotation(folder.path(), plates(-kSmall_Nm), "disc_4.face")).epsilon(0.01));

  const auto refused = [&](const std::string& key, const char* message) {
    const auto model = testing::write_text(folder / "bad.toml", one_body(kSmall_Nm, key));
    const testing::CommandOutcome outcome =
        testing::run_flexneck("simulate " + model.string() + " -q -o " + folder.path().string());
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.text, Contains(message));
  };
  refused("modes = [\"shut 1\"]\n", "takes all its modes");
  refused("stress_stiffening = true\n", "stress_stiffening");
}
