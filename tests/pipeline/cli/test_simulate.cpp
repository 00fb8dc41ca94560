// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of the built command.
#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/foundation/printable.h"
#include "geometry/foundation/temporary_folder.h"
#include "multibody/analysis/linearisation.h"
#include "multibody/files/history_file.h"
#include "pipeline/language/model/model_file.h"
#include "tests/support/files.h"
#include "tests/support/flexneck_command.h"
#include "tests/support/model_text.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using testing::bytes_of;
using testing::CommandOutcome;
using testing::double_pendulum_text;
using testing::with;
using testing::write_test_file;

namespace {

namespace fs = std::filesystem;

CommandOutcome simulate(const fs::path& model, const fs::path& out, const std::string& more = "") {
  return testing::run_flexneck("simulate " + model.string() + " --out " + out.string() + more);
}

std::ptrdiff_t lines_in(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

}  // namespace

TEST_CASE("simulate writes histories and a table, tells what it took, and does so again") {
  const TemporaryFolder folder;
  const fs::path model = write_test_file(folder / "swing.toml", double_pendulum_text());
  const CommandOutcome outcome = simulate(model, folder / "out");
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.text, Contains("steps") && Contains("rejected") &&
                               Contains("lower.tip acceleration") && Contains("largest"));
  const auto file = multibody::read_history(folder / "out/swing.h5");
  CHECK(file.history.time_s.size() == 201);
  CHECK(file.channels.size() == 5 * 4 + 2 * 2 + 1);
  CHECK(file.provenance.inputs.at(0).name == "swing.toml");
  const std::string table = bytes_of(folder / "out/swing.csv");
  CHECK(lines_in(table) == 202);
  CHECK_THAT(table, Catch::Matchers::StartsWith("time [s],ground.hook position x [m],"));
  // The numbers are read back exactly.
  const std::string last = table.substr(table.rfind('\n', table.size() - 2) + 1);
  CHECK(std::stod(last) == file.history.time_s[200]);

  REQUIRE(simulate(model, folder / "again", " -q").exit_code == 0);
  for (const char* name : {"swing.h5", "swing.csv"})
    CHECK(bytes_of(folder / "out" / name) == bytes_of(folder / "again" / name));
}

TEST_CASE("simulate tells what branches were fitted to, how well, and their loss factor") {
  const TemporaryFolder folder;
  const fs::path model = write_test_file(
      folder / "rubber.toml",
      "[solver]\nend_time = \"10 ms\"\n[[body]]\nname = \"ground\"\nkind = \"ground\"\n" +
          testing::origin_marker_text("ground", "hook") + testing::box_text("box", "at") + R"(
[[section]]
name = "rubber"
lower = "ground.hook"
upper = "box.at"
length = ["0 m", "0 mm", "20 mm"]
translation_stiffness = ["1 N/m", "1 N/m", "1 N/m"]
rotation_stiffness = ["1 N*m/rad", "1 N*m/rad", "1 N*m/rad"]
relaxation_law = { branches = 5, share = 0.6, time = "30 ms", order = 0.5, from = "1 Hz", to = "20 Hz", largest_error = 0.1 }
)");
  const CommandOutcome outcome = simulate(model, folder / "out");
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.text, Contains("loss factor") && Contains("rubber: Maxwell branches") &&
                               Contains("largest error"));
}

TEST_CASE("simulate tells the modes of small motions and keeps their shapes") {
  const TemporaryFolder folder;
  const fs::path model =
      write_test_file(folder / "swing.toml",
                      double_pendulum_text() + "\n[linearisation]\nabout = \"equilibrium\"\n");
  const CommandOutcome outcome = simulate(model, folder / "out", " --set 'solver.end_time=10 ms'");
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.text, Contains("mode about equilibrium") && Contains("largest motion"));
  const auto file = multibody::read_history(folder / "out/swing.h5");
  REQUIRE(file.linearisation);
  CHECK(file.linearisation->about == "equilibrium");
  CHECK(file.linearisation->markers.back() == "lower.tip");
  const auto expected = multibody::linearise(pipeline::read_model_file(model, {}).model,
                                             multibody::LinearisedAt::equilibrium);
  REQUIRE(file.linearisation->modes.size() == 2);
  for (std::size_t k = 0; k < 2; ++k) {
    const multibody::ModeShape& found = file.linearisation->modes[k];
    CHECK(found.mode.frequency_Hz > 0.1);
    CHECK(found.mode.frequency_Hz == expected[k].mode.frequency_Hz);
    CHECK(found.mode.damping_ratio == expected[k].mode.damping_ratio);
    CHECK(found.translation == expected[k].translation);
    CHECK(found.rotation == expected[k].rotation);
    CHECK(found.translation.cwiseAbs().maxCoeff() == Approx(1));
  }
}

TEST_CASE("simulate draws a Campbell diagram and says which motion about steady rotation grows") {
  // 1 kg on a rail that rotates with the hub, connected to the axis by 400 N/m.
  const std::string text = R"(
[solver]
end_time = "2 ms"
[linearisation]
about = "equilibrium"
rates = ["0 rad/s", "10 rad/s", "30 rad/s"]
[[body]]
name = "hub"
kind = "prescribed"
[body.turn]
axis = [0, 0, 1]
initial_rate = "30 rad/s"
[[body]]
name = "block"
kind = "rigid"
mass = "1 kg"
center = ["0 m", "0 m", "0 m"]
inertia = ["0.01 kg*m^2", "0.01 kg*m^2", "0.01 kg*m^2"]
[[marker]]
body = "hub"
name = "rail"
position = ["0 m", "0 m", "0 m"]
[[marker]]
body = "block"
name = "centre"
position = ["0 m", "0 m", "0 m"]
[[joint]]
name = "rail"
kind = "prismatic"
axis = [1, 0, 0]
lower = "hub.rail"
upper = "block.centre"
[[resistance]]
name = "spring"
joint = "rail"
coordinate = "distance"
stiffness = "400 N/m"
)";
  const TemporaryFolder folder;
  const CommandOutcome outcome =
      simulate(write_test_file(folder / "rotor.toml", text), folder / "out");
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
  // sqrt(30^2 - 20^2) / s.
  CHECK_THAT(outcome.text,
             Contains("mode about steady rotation") && Contains("UNSTABLE, grows by 22.36 / s"));
  const auto file = multibody::read_history(folder / "out/rotor.h5");
  CHECK(file.linearisation->modes[0].mode.growth_rate_1_s == Approx(std::sqrt(500.)).epsilon(1e-7));
  const std::string table = bytes_of(folder / "out/rotor-campbell.csv");
  CHECK(lines_in(table) == 4);
  CHECK_THAT(table, Contains("rate [rad/s],mode 1 frequency [Hz]") &&
                        Contains("\n10,2.7566444"));  // sqrt(300) / 2 pi
  CHECK_THAT(bytes_of(folder / "out/rotor-campbell.svg"), Contains("one per revolution"));
  const CommandOutcome refused = simulate(folder / "rotor.toml", folder / "no",
                                          " --set 'solver.gravity=[\"1 gn\", \"0 gn\", \"0 gn\"]'");
  CHECK(refused.exit_code == 2);
  CHECK_THAT(refused.text, Contains("rotor.toml: gravity is not parallel to the axis"));
}

TEST_CASE("a model that is not sound ends in one line, exit code 2 and no file") {
  const TemporaryFolder folder;
  const auto check_refused = [&](const std::string& part, const std::string& by,
                                 const std::string& reason) {
    const fs::path model =
        write_test_file(folder / "bad.toml", with(double_pendulum_text(), part, by));
    const CommandOutcome outcome = simulate(model, folder / "out", " -q");
    INFO(outcome.text);
    CHECK(outcome.exit_code == 2);
    CHECK(lines_in(outcome.text) == 1);
    CHECK_THAT(outcome.text, Contains("bad.toml") && Contains(reason));
    CHECK_FALSE(fs::exists(folder / "out"));
  };
  check_refused("upper = \"lower.top\"", "upper = \"lower.topp\"", "did you mean 'lower.top'?");
  check_refused("name = \"lower\"\nkind",
                "name = \"lower\"\nposition = [\"1 m\", \"0 m\", \"0 m\"]\nkind",
                "remove one of them");
  const CommandOutcome none = testing::run_flexneck("simulate");
  CHECK(none.exit_code == 2);
  CHECK_THAT(none.text, Contains("expected one model"));
}

TEST_CASE("what a terminal would obey reaches it spelt out, in one line of bounded length") {
  const TemporaryFolder folder;
  const std::string simulate = "simulate -o " + (folder / "out").string() + " ";
  const fs::path evil = folder / "a\x1b]0;title\a\nb.toml";
  const auto check_refused = [&](const std::string& line, const std::string& shown) {
    const CommandOutcome outcome = testing::run_flexneck(line);
    INFO(outcome.text);
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.text, Contains(shown));
    CHECK(lines_in(outcome.text) == 1);
    CHECK(outcome.text.size() < 5000);
    CHECK(find_unprintable(outcome.text, "\n") == std::string::npos);
  };
  check_refused(simulate + "'" + evil.string() + "'", "a\\x1b]0;title\\x07\\nb.toml: no such file");
  write_test_file(evil, double_pendulum_text() + "\n[[body]]\n");
  check_refused(simulate + "'" + evil.string() + "'", "a\\x1b]0;title\\x07\\nb.toml:");
  check_refused("'\x1b[2J'", "there is no command '\\x1b[2J'");
  check_refused("--'\x1b[2J'", "\\x1b[2J");
  check_refused("study --set 'a\x1b=1'", "--set a\\x1b=1");
  const fs::path named = write_test_file(
      folder / "named.toml", with(double_pendulum_text(), "\"shoulder\"", "\"\\u001b[31m\""));
  check_refused(simulate + named.string(), "found \"\\x1b[31m\"");
  const fs::path wide = write_test_file(
      folder / "wide.toml",
      with(double_pendulum_text(), "\"upper.top\"", "\"" + std::string(1'000'000, 'x') + "\""));
  check_refused(simulate + wide.string(), "[…]");
}

TEST_CASE("a run that cannot go on says when and why and keeps what it has, marked incomplete") {
  const TemporaryFolder folder;
  const fs::path model = write_test_file(folder / "stuck.toml", double_pendulum_text());
  const CommandOutcome outcome = simulate(model, folder / "out", " -q --set solver.max_steps=20");
  INFO(outcome.text);
  CHECK(outcome.exit_code == 3);
  CHECK(lines_in(outcome.text) == 1);
  CHECK_THAT(outcome.text,
             Contains("stopped at") && Contains("after 20 steps") && Contains("marked incomplete"));
  const auto file = multibody::read_history(folder / "out/stuck.h5");
  CHECK_THAT(file.history.incomplete, Contains("stopped"));
  CHECK(file.history.time_s.size() > 1);
  CHECK(file.history.time_s.size() < 201);
  CHECK(lines_in(bytes_of(folder / "out/stuck.csv")) == file.history.time_s.size() + 1);
}
