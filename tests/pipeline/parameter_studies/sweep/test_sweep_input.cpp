// SPDX-License-Identifier: GPL-3.0-or-later
// Input of a sweep: what is accepted, its interpretation, and refusals.
#include <filesystem>

#include <catch2/catch.hpp>

#include "geometry/foundation/temporary_folder.h"
#include "tests/pipeline/parameter_studies/sweep/sweep_runs.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::testing;
namespace fs = std::filesystem;

TEST_CASE("a row that fails has its reason and no figures, the others theirs") {
  const TemporaryFolder folder;
  const fs::path study = testing::write_beam_study(
      folder.path(),
      small_sweep(
          "name = \"mass\"\nkey = \"body.head.mass\"\nunit = \"kg\"\nvalues = [4, -1, 5]\n"));
  const testing::CommandOutcome outcome = run_flexneck(sweep(study, folder / "out"));
  INFO(outcome.text);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.text, Contains("3 rows, 1 failed"));
  const fs::path other = testing::write_beam_study(
      folder.path(), small_sweep("name = \"top\"\nkey = \"interface.top.set\"\n"
                                 "texts = [\"Tip\", \"Nowhere\"]\n"));
  const testing::CommandOutcome failing = run_flexneck(sweep(other, folder / "other"));
  INFO(failing.text);
  CHECK(failing.exit_code == 0);
  CHECK_THAT(failing.text, Contains("2 rows, 1 failed"));
  const std::vector<std::string> lines = lines_of(bytes_of(folder / "other/sweep.csv"));
  REQUIRE(lines.size() == 3);
  CHECK(lines[0] == "row,top,pendulum.flexion.head_rotation [rad],problem");
  CHECK_THAT(lines[1], Catch::Matchers::StartsWith("0,Tip,0."));
  CHECK_THAT(lines[2], Catch::Matchers::StartsWith("1,Nowhere,nan,") && Contains("Nowhere"));
}

TEST_CASE("what is wrong with a sweep is told in one line") {
  const std::string damping = "key = \"body.neck.damping_ratio\"\nvalues = [0.5, 0.6]\n";
  check_refused(outcome_of(""), "expected [sweep]");
  check_refused(
      outcome_of(small_sweep("key = \"pulse.long.times\"\ntexts = ['[\"0 ms\", \"10 ms\", "
                             "\"60 ms\", \"80 ms\"]', '[\"0 ms\", \"10 ms\", \"60 ms\", "
                             "\"90 ms\"]']\n")),
      "expected a key that an output depends on, found 'pulse.long.times'");
  check_refused(
      outcome_of(small_sweep("key = \"modes.solver\"\ntexts = [\"cholmod\", \"mumps\"]\n")),
      "expected a key that an output depends on");
  check_refused(outcome_of(small_sweep(damping, "\"pendulum.flexion.head\"")), "figure");
  check_refused(outcome_of(small_sweep("key = \"modes.count\"\nvalues = [3, 4]\n",
                                       "\"modes.frequency.torsion 7\"")),
                "torsion 7");
  check_refused(outcome_of(small_sweep("key = \"body.neck.dampng\"\nvalues = [0.5]\n")),
                "sweep.parameter 'body.neck.dampng'");
  check_refused(outcome_of(small_sweep("key = \"body.head.mass\"\nunit = \"m\"\nvalues = [5]\n")),
                "expected a unit such as kg, found 'm'");
  check_refused(outcome_of(small_sweep("key = \"body.head.mass\"\nvalues = [5]\n")),
                "expected a number with its unit");
  check_refused(outcome_of(small_sweep(damping + "[[sweep.parameter]]\n" + damping)), "twice");
  check_refused(outcome_of(small_sweep("key = \"body.neck.damping_ratio\"\n")), "expected values");
  check_refused(outcome_of(small_sweep(damping, "")), "expected at least one output or curve");
  check_refused(outcome_of(small_sweep(damping + "mean = 3\n")), "sweep.parameter");
  check_refused(
      outcome_of(small_sweep(damping, "\"pendulum.flexion.head_rotation\"", "plan = \"sobol\"")),
      "samples: expected this key");
  check_refused(
      outcome_of(small_sweep(damping, "\"pendulum.flexion.head_rotation\"", "plan = \"cube\"")),
      "expected one of");
  check_refused(outcome_of(small_sweep("key = \"sweep.seed\"\nvalues = [1, 2]\n")),
                "one of the sweep itself");
}

TEST_CASE("a sweep of which all rows fail ends with the reason") {
  const testing::CommandOutcome outcome =
      outcome_of(small_sweep("key = \"interface.top.set\"\ntexts = [\"There\", \"Nowhere\"]\n"));
  INFO(outcome.text);
  CHECK(outcome.exit_code == 3);
  CHECK_THAT(
      outcome.text,
      Contains("output 'pendulum.flexion.head_rotation': not computed in any row of the sweep"));
}

TEST_CASE("options of a sweep are obeyed or refused") {
  const TemporaryFolder folder;
  const fs::path study = testing::write_beam_study(folder.path(), kHypercube);
  for (const char* const shard : {"0/3", "4/3", "1", "1/", "a/b", "1/2/3", "-1/2"})
    check_refused(run_flexneck(sweep(study, folder / "out", std::string("--shard=") + shard)),
                  "expected a part such as 2/8");
  CHECK(run_flexneck(sweep(study, folder / "out", "--threads 0")).exit_code == 2);
  CHECK(run_flexneck("run --shard 1/2").exit_code == 2);
}

TEST_CASE("a study with a sweep runs as one without") {
  const TemporaryFolder folder;
  require_done("modes " + testing::write_beam_study(folder.path(), "").string() + " -o " +
               (folder / "x").string() + " --help");
  const fs::path study = testing::write_beam_study(folder.path(), kHypercube);
  require_done("run " + study.string() + " -o " + (folder / "out").string());
}

TEST_CASE("a grid and a list have the rows that their values make, in order") {
  const TemporaryFolder folder;
  const std::string two =
      "[[sweep.parameter]]\nname = \"a\"\nkey = \"body.neck.damping_ratio\"\n"
      "values = [0.5, 0.7]\n[[sweep.parameter]]\nname = \"b\"\n"
      "key = \"case.flexion.impact_velocity\"\nunit = \"m/s\"\n";
  const auto inputs_of = [&](const std::string& plan, const std::string& b) {
    const fs::path study = testing::write_beam_study(
        folder.path(), "[sweep]\nplan = \"" + plan +
                           "\"\noutputs = [\"pendulum.flexion.head_rotation\"]\n" + two + b);
    fs::remove_all(folder / "out");
    require_done(sweep(study, folder / "out"));
    std::vector<std::string> inputs;
    for (const std::string& line : lines_of(bytes_of(folder / "out/sweep.csv")))
      inputs.push_back(line.substr(0, line.find(',', line.find(',', line.find(',') + 1) + 1)));
    return inputs;
  };
  using Lines = std::vector<std::string>;
  CHECK(
      inputs_of("grid", "from = 1\nto = 2\nsteps = 3\n") ==
      Lines{"row,a,b [m/s]", "0,0.5,1", "1,0.5,1.5", "2,0.5,2", "3,0.7,1", "4,0.7,1.5", "5,0.7,2"});
  CHECK(inputs_of("list", "values = [1, 2]\n") == Lines{"row,a,b [m/s]", "0,0.5,1", "1,0.7,2"});
}

TEST_CASE("a parameter may be a variable, with a unit of its own, and correlated") {
  const TemporaryFolder folder;
  const fs::path study = write_beam_study(folder.path(), R"([variables]
speed = "2 m/s"
[[case]]
name = "other"
kind = "pendulum"
pulse = "short"
impact_velocity = "$speed"
[sweep]
plan = "shapley"
samples = 8
outputs = ["pendulum.other.head_rotation"]
[[sweep.parameter]]
name = "speed"
key = "variables.speed"
unit = "km/h"
distribution = "uniform"
from = 7.2
to = 9
[[sweep.parameter]]
name = "damping"
key = "body.neck.damping_ratio"
distribution = "normal"
mean = 0.9
standard_deviation = 0.05
[[sweep.correlation]]
of = ["speed", "damping"]
coefficient = 0.5
)");
  require_done(sweep(study, folder / "out"));
  const std::vector<std::string> lines = lines_of(bytes_of(folder / "out/sweep.csv"));
  REQUIRE(lines.size() == 33);  // 8 samples have 4 rows each
  CHECK(lines[0] == "row,speed [m/s],damping,pendulum.other.head_rotation [rad],problem");
  for (std::size_t k = 1; k < lines.size(); ++k) {
    const double speed = std::stod(lines[k].substr(lines[k].find(',') + 1));
    CHECK(speed > 2);
    CHECK(speed < 2.5);
  }
  CHECK_THAT(bytes_of(folder / "out/sweep.json"), Contains("shapley effects"));
  const CommandOutcome told = run_flexneck("info " + (folder / "out/sweep.h5").string());
  CHECK(told.exit_code == 0);
  CHECK_THAT(told.text, Contains("inputs speed [m/s]: 32 rows") &&
                            Contains("outputs pendulum.other.head_rotation [rad]: 32 rows"));
}
