// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of 'flexneck sweep': sharded, killed, stopped, on a full disk.
#include <chrono>
#include <fstream>

#include <catch2/catch.hpp>

#include "geometry/foundation/temporary_folder.h"
#include "tests/pipeline/parameter_studies/sweep/sweep_runs.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::testing;
namespace fs = std::filesystem;

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
  // Nothing remains to be computed, and the results do not change.
  require_done(sweep(study, folder / "shards"));
  CHECK(table_in(folder / "shards") == table);
  CHECK(lines_of(bytes_of(folder / "one/sweep.csv")).size() == 61);
}

TEST_CASE("shards that are not all there are completed without --shard") {
  const TemporaryFolder folder;
  const fs::path study = testing::write_beam_study(folder.path(), kHypercube);
  require_done(sweep(study, folder / "one"));
  require_done(sweep(study, folder / "some", "--shard 2/4"));
  CHECK_FALSE(fs::exists(folder / "some/sweep.csv"));
  const testing::CommandOutcome outcome = run_flexneck(sweep(study, folder / "some"));
  CHECK_THAT(outcome.text, Contains("45 rows to compute, 15 already computed"));
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
    // Start anew, so that there is a run to be killed.
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
  CHECK_THAT(outcome.text, Contains("20 rows to compute, 40 already computed"));
  CHECK(table_in(folder / "out") == table);
}

TEST_CASE("other values begin a sweep anew, and say so") {
  const TemporaryFolder folder;
  const fs::path study = testing::write_beam_study(folder.path(), kHypercube);
  require_done(sweep(study, folder / "out"));
  const testing::CommandOutcome outcome =
      run_flexneck(sweep(study, folder / "out", "--set case.flexion.duration='0.2 s'"));
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.text,
             Contains("started again") && Contains("60 rows to compute, 0 already computed"));
}

TEST_CASE("Ctrl-C keeps what is done") {
  // With --foreground, timeout signals only the command, and once.
  const TemporaryFolder folder;
  const fs::path study = testing::write_beam_study(
      folder.path(),
      small_sweep("key = \"body.neck.damping_ratio\"\ndistribution = \"uniform\"\n"
                  "from = 0.5\nto = 0.9\n",
                  R"("pendulum.far.head_acceleration")", "plan = \"random\"\nsamples = 100000"));
  // A busy machine may need longer until its first rows.
  testing::CommandOutcome outcome;
  std::size_t lines = 0;
  for (const char* const seconds : {"1.5", "6", "24"}) {
    outcome = run_shell("timeout --foreground -s INT " + std::string(seconds) + " " +
                        testing::flexneck_program() + " " + sweep(study, folder / "out"));
    const fs::path rows = folder / "out/sweep-shards/1-of-1/rows.txt";
    lines = fs::exists(rows) ? lines_of(bytes_of(rows)).size() - 1 : 0;  // one names the files
    if (lines > 2) break;
  }
  INFO(outcome.text);
  CHECK_THAT(outcome.text, Contains("of 100000 rows are complete and kept"));
  CHECK(lines > 2);
  CHECK_THAT(outcome.text, Contains(std::to_string(lines - 1) + " of 100000"));
}

TEST_CASE("a disk that fills up ends a sweep with one line, and then it goes on") {
  const TemporaryFolder folder;
  const fs::path study = testing::write_beam_study(folder.path(), kHypercube);
  require_done(sweep(study, folder / "whole"));
  // A limit of 2 kB per file simulates a full disk.
  const testing::CommandOutcome outcome =
      run_shell("sh -c 'ulimit -f 4; exec " + testing::flexneck_program() + " -q " +
                sweep(study, folder / "full") + "'");
  check_refused(outcome, "cannot be written", 3);
  CHECK_THAT(outcome.text, Contains("completed rows are kept"));
  require_done(sweep(study, folder / "full"));
  CHECK(table_in(folder / "full") == table_in(folder / "whole"));
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
  // Figures of outputs that a later sweep does not have are removed from the page.
  require_done(sweep(study, folder / "out",
                     "--set 'sweep.outputs=[\"modes.mass\", "
                     "\"pendulum.flexion.head_rotation\"]'"));
  CHECK_FALSE(fs::exists(folder / "out/sweep-tornado-pendulum.flexion.neck_rotation_time.svg"));
}

namespace {

/// A clamped bar whose script includes its half width, and a sweep of its density.
fs::path write_bar_sweep(const fs::path& folder) {
  std::ofstream(folder / "bar.geo") << R"(SetFactory("Built-in");
Include "width.geo";
Point(1) = {0, -W, -W}; Point(2) = {0, W, -W};
Line(1) = {1, 2}; Transfinite Curve {1} = 3;
s[] = Extrude {0, 0, 2*W} { Line{1}; Layers{2}; Recombine; };
b[] = Extrude {0.1, 0, 0} { Surface{s[1]}; Layers{6}; Recombine; };
Physical Volume("bar", 1) = {b[1]};
Physical Surface("clamp", 2) = {s[1]};
Physical Surface("tip", 3) = {b[0]};
)";
  std::ofstream(folder / "width.geo") << "W = 0.010;";
  std::ofstream(folder / "bar.toml") << R"([geometry]
script = "bar.geo"
[geometry.materials.steel]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
density = "7850 kg/m^3"
parts = ["bar"]
[modes]
count = 3
fixed = ["clamp"]
[[interface]]
name = "root"
set = "clamp"
position = ["0 mm", "0 mm", "0 mm"]
[[interface]]
name = "end"
set = "tip"
position = ["100 mm", "0 mm", "0 mm"]
[sweep]
plan = "grid"
outputs = ["modes.frequency.mode 1"]
[[sweep.parameter]]
key = "geometry.materials.steel.density"
unit = "kg/m^3"
values = [7000, 28000]
)";
  return folder / "bar.toml";
}

/// The frequency in a row of sweep.csv, in the last cell but one; the last is the problem.
double frequency_Hz(const fs::path& out, std::size_t row) {
  const std::string line = lines_of(bytes_of(out / "sweep.csv")).at(1 + row);
  std::istringstream cells(line);
  std::string cell;
  for (int k = 0; k < 3; ++k) std::getline(cells, cell, ',');
  return std::stod(cell);
}

}  // namespace

TEST_CASE("a table never holds rows of two states of a file that a script includes") {
  const TemporaryFolder folder;
  const fs::path study = write_bar_sweep(folder.path());
  const fs::path out = folder / "out";
  require_done(sweep(study, out, "--shard 1/2"));
  std::ofstream(folder / "width.geo") << "W = 0.005;";
  const testing::CommandOutcome second = run_flexneck(sweep(study, out, "--shard 2/2"));
  CHECK_THAT(second.text, Contains("the rows were computed from a different version of") &&
                              Contains("width.geo") && Contains("run that part again"));
  CHECK_FALSE(fs::exists(out / "sweep.csv"));
  require_done(sweep(study, out, "--shard 1/2"));
  // Four times the density: half the frequency, which both rows of one state have.
  CHECK(frequency_Hz(out, 0) == Approx(2 * frequency_Hz(out, 1)).epsilon(1e-9));
  const double thin_Hz = frequency_Hz(out, 0);
  std::ofstream(folder / "width.geo") << "W = 0.010;";
  const testing::CommandOutcome whole = run_flexneck(sweep(study, out));
  CHECK_THAT(whole.text, Contains("2 rows to compute, 0 already computed"));
  CHECK(frequency_Hz(out, 0) > 1.9 * thin_Hz);
}

TEST_CASE("a part beside those of another study, and of a script that runs commands, is told") {
  const TemporaryFolder folder;
  const fs::path study = write_bar_sweep(folder.path());
  const auto second_after = [&](const fs::path& out, const std::string& more) {
    require_done(sweep(study, out, "--shard 1/2"));
    const testing::CommandOutcome second = run_flexneck(sweep(study, out, "--shard 2/2 " + more));
    CHECK_FALSE(fs::exists(out / "sweep.csv"));
    return second.text;
  };
  CHECK_THAT(second_after(folder / "two", "--set modes.count=4"),
             Contains("1-of-2/rows.txt: the rows belong to another study, other values or another "
                      "program version; run that part again"));
  std::ofstream(folder / "bar.geo", std::ios::app) << "SystemCall \"true\";\n";
  CHECK_THAT(second_after(folder / "unknown", ""),
             Contains("its rows are valid for one process only; run without --shard"));
  require_done(sweep(study, folder / "unknown"));
  CHECK(frequency_Hz(folder / "unknown", 0) ==
        Approx(2 * frequency_Hz(folder / "unknown", 1)).epsilon(1e-9));
}

TEST_CASE("a sweep whose rows cannot be read is not done, and says so") {
  const TemporaryFolder folder;
  const fs::path study = testing::write_beam_study(folder.path(), kHypercube);
  require_done(sweep(study, folder / "out"));
  const std::string table = table_in(folder / "out");
  const fs::path shim =
      fs::path(testing::flexneck_program()).parent_path() / "tests/reliability/fault_shim.so";
  if (!fs::exists(shim)) return;  // two of them cannot both stand before the C library
  const fs::path note = folder / "note";
  int reached = 0;
  for (int call = 1; call <= 12; ++call) {
    std::ofstream(note) << std::string(4096, '\0');
    fs::remove(folder / "out/sweep.csv");
    const testing::CommandOutcome outcome =
        run_shell("env LD_PRELOAD=" + shim.string() + " FAULT_NOTE=" + note.string() +
                  " FAULT_FOLDER=" + (folder / "out/sweep-shards").string() +
                  " FAULT_KIND=pread FAULT_ERROR=5 FAULT_LASTS=0 FAULT_AT=" + std::to_string(call) +
                  " " + testing::flexneck_program() + " " + sweep(study, folder / "out", "-q"));
    INFO(call << ": " << outcome.text);
    if (outcome.exit_code == 0) {
      CHECK(table_in(folder / "out") == table);
    } else {
      ++reached;
      CHECK(outcome.exit_code == 3);
      CHECK_THAT(outcome.text, Contains("rows.txt") && Contains("cannot be read"));
    }
  }
  CHECK(reached > 3);
  require_done(sweep(study, folder / "out"));
  CHECK(table_in(folder / "out") == table);
}
