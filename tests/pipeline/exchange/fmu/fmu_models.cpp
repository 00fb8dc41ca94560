// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/pipeline/exchange/fmu/fmu_models.h"

#include <catch2/catch.hpp>

#include "tests/support/flexneck_command.h"
#include "tests/support/modal_files.h"
#include "tests/support/model_reading.h"

namespace flexneck::testing {

std::string sled_text(const std::string& acceleration) {
  return R"(
[solver]
end_time = "0.1 s"
relative_tolerance = 1e-9
absolute_tolerance = 1e-12
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
start = "equilibrium"
[output]
interval = "1 ms"
[[body]]
name = "sled"
kind = "prescribed"
)" + acceleration +
         neck_and_head_text() +
         R"([[marker]]
body = "sled"
name = "seat"
position = ["0 m", "0 m", "0 m"]
[[marker]]
body = "sled"
name = "hook"
position = ["-0.2 m", "0 m", "0.2 m"]
[[marker]]
body = "head"
name = "joint"
position = ["0 m", "0 m", "0 m"]
[[marker]]
body = "head"
name = "top"
position = ["0 m", "0 m", "0.1 m"]
[[joint]]
name = "seat"
kind = "fixed"
lower = "sled.seat"
upper = "neck.base"
[[joint]]
name = "condyles"
kind = "fixed"
lower = "neck.top"
upper = "head.joint"
[[spring]]
name = "strap"
lower = "sled.hook"
upper = "head.top"
free_length = "0.22 m"
stiffness = "3000 N/m"
tension_only = true
damping = "5 N*s/m"
[[force]]
name = "push"
marker = "head.top"
direction = [0, 1, 0]
times = ["0 ms", "20 ms", "30 ms"]
magnitudes = ["0 N", "60 N", "0 N"]
[[channel]]
name = "top"
quantity = "position"
marker = "head.top"
[[channel]]
name = "nod"
quantity = "angle"
marker = "head.top"
axis = [0, 1, 0]
[[channel]]
name = "condyles"
quantity = "moment"
joint = "condyles"
[[channel]]
name = "energy"
quantity = "energy"
)";
}

std::string block_text(const std::string& analysis, const std::string& more) {
  return R"(
[solver]
end_time = "1 s"
analysis = ")" +
         analysis + R"("
[output]
interval = "0.1 s"
[[body]]
name = "ground"
kind = "ground"
[[body]]
name = "block"
kind = "rigid"
mass = "2 kg"
center = ["0 m", "0 m", "0 m"]
inertia = ["1e-3 kg*m^2", "1e-3 kg*m^2", "1e-3 kg*m^2"]
[[marker]]
body = "ground"
name = "rail"
position = ["0 m", "0 m", "0 m"]
[[marker]]
body = "block"
name = "center"
position = ["0 m", "0 m", "0 m"]
[[joint]]
name = "slide"
kind = "prismatic"
lower = "ground.rail"
upper = "block.center"
axis = [1, 0, 0]
[[channel]]
name = "place"
quantity = "position"
marker = "block.center"
[[channel]]
name = "rail"
quantity = "force"
joint = "slide"
[[channel]]
name = "energy"
quantity = "energy"
)" + more;
}

std::filesystem::path unpacked(const TemporaryFolder& folder, const std::string& text) {
  write_beam_modes(folder / "neck.h5");
  write_test_file(folder / "sled.toml", text);
  const std::string at = folder.path().string();
  const auto outcome = run_flexneck("export -q " + at + "/sled.toml --to " + at + "/sled.fmu");
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
  REQUIRE(run_shell("unzip -q -o " + at + "/sled.fmu -d " + at + "/fmu").exit_code == 0);
  return folder / "fmu";
}

}  // namespace flexneck::testing
