// SPDX-License-Identifier: GPL-3.0-or-later
// 'flexneck sweep' as users run it: shared out, killed, stopped, on a full disk, with bad input.
#include <chrono>
#include <fstream>
#include <sstream>

#include <catch2/catch.hpp>

#include "geometry/foundation/temporary_folder.h"
#include "tests/support/beam_study.h"
#include "tests/support/files.h"
#include "tests/support/flexneck_command.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using testing::bytes_of;
using testing::check_refused;
using testing::run_flexneck;
using testing::run_shell;

namespace {

namespace fs = std::filesystem;

const std::string kHypercube = R"([sweep]
plan = "latin_hypercube"
samples = 60
outputs = ["pendulum.flexion.head_rotation", "pendulum.flexion.neck_rotation_time"]
curves = ["pendulum.flexion.occipital moment"]
[[sweep.parameter]]
name = "damping"
key = "body.neck.damping_ratio"
distribution = "lognormal"
mean = 0.9
standard_deviation = 0.1
[[sweep.parameter]]
key = "body.head.mass"
unit = "lb"
distribution = "normal"
mean = 9.9
standard_deviation = 0.5
)";

std::string sweep(const fs::path& study, const fs::path& out, const std::string& more = "") {
  return "sweep " + study.string() + " -o " + out.string() + " " + more;
}

void require_done(const std::string& arguments) {
  const testing::CommandOutcome outcome = run_flexneck(arguments);
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
}

/// The files of a table, one after the other.
std::string table_in(const fs::path& out) {
  std::string bytes;
  for (const char* const name : {"sweep.csv", "sweep.h5", "sweep.json",
                                 "sweep-bands-pendulum.flexion.occipital-moment.csv"}) {
    const std::string content = bytes_of(out / name);
    CHECK_FALSE(content.empty());
    bytes += content;
  }
  return bytes;
}

/// A study with one parameter and one output.
std::string small_sweep(const std::string& parameter,
                        const std::string& outputs = R"("pendulum.flexion.head_rotation")",
                        const std::string& plan = "plan = \"grid\"") {
  return "[sweep]\n" + plan + "\noutputs = [" + outputs + "]\n[[sweep.parameter]]\n" + parameter;
}

testing::CommandOutcome outcome_of(const std::string& section) {
  const TemporaryFolder folder;
  return run_flexneck(sweep(testing::write_beam_study(folder.path(), section), folder / "out"));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace

TEST_CASE("a sweep is the same to the last bit with any threads and shards") {
  const TemporaryFolder folder;
  const fs::path study = testing::write_beam_study(folder.path(), kHypercube);
  require_done(sweep(study, folder / "one", "--threads 1"));
  require_done(sweep(study, folder / "two", "--threads 2"));
  for (const char* const shard : {"3/3", "1/3", "2/3"})
    require_done(sweep(study, folder / "shards", std::string("--threads 1 --shard ") + shard));
  const std::string table = table_in(folder / "one");
  CHECK(table_in(folder / "two") == table);
  CHECK(table_in(folder / "shards") == table);
  // Nothing is left to do, and nothing changes.
  require_done(sweep(study, folder / "shards"));
  CHECK(table_in(folder / "shards") == table);
  CHECK(lines_of(bytes_of(folder / "one/sweep.csv")).size() == 61);
}

TEST_CASE("processes of mpirun are shards") {
  const TemporaryFolder folder;
  const fs::path study = testing::write_beam_study(folder.path(), kHypercube);
  require_done(sweep(study, folder / "one"));
  const std::string mpirun =
      "timeout 100 env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
      "OMPI_MCA_rmaps_base_oversubscribe=1 mpirun --quiet -n 2 " +
      testing::flexneck_program() + " ";
  const testing::CommandOutcome outcome = run_shell(mpirun + sweep(study, folder / "two"));
  INFO(outcome.text);
  CHECK(outcome.exit_code == 0);
  CHECK(fs::exists(folder / "two/sweep-shards/2-of-2/rows.txt"));
  CHECK(table_in(folder / "two") == table_in(folder / "one"));
  const testing::CommandOutcome refused =
      run_shell(mpirun + sweep(study, folder / "two", "--shard 1/2"));
  CHECK(refused.exit_code == 2);
  CHECK_THAT(refused.text, Contains("expected none under mpirun"));
}

TEST_CASE("shards that are not all there are completed without --shard") {
  const TemporaryFolder folder;
  const fs::path study = testing::write_beam_study(folder.path(), kHypercube);
  require_done(sweep(study, folder / "one"));
  require_done(sweep(study, folder / "some", "--shard 2/4"));
  CHECK_FALSE(fs::exists(folder / "some/sweep.csv"));
  const testing::CommandOutcome outcome = run_flexneck(sweep(study, folder / "some"));
  CHECK_THAT(outcome.text, Contains("45 rows to compute, 15 there already"));
  CHECK(table_in(folder / "some") == table_in(folder / "one"));
}

TEST_CASE("twenty kills leave the same table") {
  const TemporaryFolder folder;
  const fs::path study = testing::write_beam_study(folder.path(), kHypercube);
  const auto start = std::chrono::steady_clock::now();
  require_done(sweep(study, folder / "whole"));
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - start;
  int killed = 0;
  unsigned random = 12345;  // any sequence of times will do
  for (int k = 0; k < 20; ++k) {
    random = random * 1664525U + 1013904223U;
    const double share = 0.2 + 0.8 * (random >> 8U) / (1U << 24U);
    const testing::CommandOutcome outcome =
        run_shell("timeout -s KILL " + std::to_string(share * whole.count()) + " " +
                  testing::flexneck_program() + " " + sweep(study, folder / "killed"));
    killed += outcome.exit_code == 137 ? 1 : 0;
    // So that there is something left to be killed.
    if (outcome.exit_code == 0) fs::remove_all(folder / "killed");
  }
  CHECK(killed > 3);
  require_done(sweep(study, folder / "killed"));
  CHECK(table_in(folder / "killed") == table_in(folder / "whole"));
}

TEST_CASE("a row that is damaged is computed again with those after it") {
  const TemporaryFolder folder;
  const fs::path study = testing::write_beam_study(folder.path(), kHypercube);
  require_done(sweep(study, folder / "out"));
  const std::string table = table_in(folder / "out");
  const fs::path rows = folder / "out/sweep-shards/1-of-1/rows.txt";
  std::string text = bytes_of(rows);
  const std::size_t place = text.find("\n40,") + 6;
  text[place] = text[place] == '7' ? '8' : '7';
  std::ofstream(rows, std::ios::binary) << text;
  const testing::CommandOutcome outcome = run_flexneck(sweep(study, folder / "out"));
  CHECK_THAT(outcome.text, Contains("20 rows to compute, 40 there already"));
  CHECK(table_in(folder / "out") == table);
}

TEST_CASE("other values begin a sweep anew, and say so") {
  const TemporaryFolder folder;
  const fs::path study = testing::write_beam_study(folder.path(), kHypercube);
  require_done(sweep(study, folder / "out"));
  const testing::CommandOutcome outcome =
      run_flexneck(sweep(study, folder / "out", "--set case.flexion.duration='0.2 s'"));
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.text, Contains("begun anew") && Contains("60 rows to compute, 0 there"));
}

TEST_CASE("Ctrl-C keeps what is done") {
  // In the foreground, timeout signals the command only, and once.
  const TemporaryFolder folder;
  const fs::path study = testing::write_beam_study(
      folder.path(),
      small_sweep("key = \"body.neck.damping_ratio\"\ndistribution = \"uniform\"\n"
                  "from = 0.5\nto = 0.9\n",
                  R"("pendulum.far.head_acceleration")", "plan = \"random\"\nsamples = 100000"));
  const testing::CommandOutcome outcome =
      run_shell("timeout --foreground -s INT 1.5 " + testing::flexneck_program() + " " +
                sweep(study, folder / "out"));
  INFO(outcome.text);
  CHECK_THAT(outcome.text, Contains("of 100000 rows are done and kept"));
  const std::size_t lines = lines_of(bytes_of(folder / "out/sweep-shards/1-of-1/rows.txt")).size();
  CHECK(lines > 2);
  CHECK_THAT(outcome.text, Contains(std::to_string(lines - 1) + " of 100000"));
}

TEST_CASE("a disk that fills up ends a sweep with one line; then it goes on") {
  const TemporaryFolder folder;
  const fs::path study = testing::write_beam_study(folder.path(), kHypercube);
  require_done(sweep(study, folder / "whole"));
  // A file may have 2 kB: that stands for the disk.
  const testing::CommandOutcome outcome =
      run_shell("sh -c 'ulimit -f 4; exec " + testing::flexneck_program() + " -q " +
                sweep(study, folder / "full") + "'");
  check_refused(outcome, "cannot be written", 3);
  CHECK_THAT(outcome.text, Contains("the rows before are kept"));
  require_done(sweep(study, folder / "full"));
  CHECK(table_in(folder / "full") == table_in(folder / "whole"));
}

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
      outcome_of(small_sweep("key = \"modes.solver\"\ntexts = [\"direct\", \"iterative\"]\n")),
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
  check_refused(outcome_of(small_sweep(damping, "")), "expected at least one figure");
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
  CHECK_THAT(outcome.text,
             Contains("output 'pendulum.flexion.head_rotation': no row of the sweep has it"));
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

TEST_CASE("a sweep has its pictures, and the report shows them with the tables") {
  const TemporaryFolder folder;
  const fs::path study = testing::write_beam_study(folder.path(), kHypercube);
  require_done("run " + study.string() + " -o " + (folder / "out").string());
  require_done(sweep(study, folder / "out"));
  for (const char* const name : {"sweep-scatter-pendulum.flexion.head_rotation.svg",
                                 "sweep-tornado-pendulum.flexion.neck_rotation_time.svg",
                                 "sweep-bands-pendulum.flexion.occipital-moment.svg"}) {
    INFO(name);
    CHECK_THAT(bytes_of(folder / "out" / name), Contains("</svg>"));
  }
  require_done("report " + study.string() + " -o " + (folder / "out").string());
  const std::string page = bytes_of(folder / "out/report.html");
  CHECK_THAT(page, Contains("Parameters varied") && Contains("Outputs over all rows") &&
                       Contains("Percentiles of all rows: pendulum.flexion.occipital-moment"));
  // Nothing of the page is left of outputs that a later sweep has not.
  require_done(sweep(study, folder / "out",
                     "--set 'sweep.outputs=[\"modes.mass\", "
                     "\"pendulum.flexion.head_rotation\"]'"));
  CHECK_FALSE(fs::exists(folder / "out/sweep-tornado-pendulum.flexion.neck_rotation_time.svg"));
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
