// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <catch2/catch.hpp>

#include "geometry/foundation/temporary_folder.h"
#include "tests/support/coarse_neck.h"
#include "tests/support/flexneck_command.h"

namespace flexneck::pipeline {
namespace {

namespace fs = std::filesystem;

using Catch::Matchers::Contains;
using testing::check_refused;
using testing::CommandOutcome;
using testing::run_flexneck;

/// Runs the command and returns standard output only: warnings are lines of any length, in which
/// tests search. Results go into `out`.
CommandOutcome printed_by(const TemporaryFolder& folder, const std::string& arguments) {
  return testing::run_shell("(cd " + folder.path().string() + "; " + testing::flexneck_program() +
                            " " + arguments + " 2>/dev/null)");
}

/// Runs the command and returns standard error, too.
CommandOutcome told_by(const TemporaryFolder& folder, const std::string& arguments) {
  return testing::run_shell("(cd " + folder.path().string() + "; " + testing::flexneck_program() +
                            " " + arguments + ")");
}

std::size_t longest_line(const std::string& text) {
  std::istringstream lines(text);
  std::size_t longest = 0;
  for (std::string line; std::getline(lines, line);) longest = std::max(longest, line.size());
  return longest;
}

}  // namespace

TEST_CASE("each command has a help of its own, and all of it fits the console") {
  const CommandOutcome all = run_flexneck("--help");
  CHECK(longest_line(all.text) <= 100);
  for (const char* const command :
       {"run", "mesh", "modes", "pictures", "static", "pendulum", "verify", "export", "report",
        "simulate", "info", "compare", "rate", "nij", "study"}) {
    INFO(command);
    CHECK_THAT(all.text, Contains("\n  " + std::string(command) + " "));
    const CommandOutcome help = run_flexneck(std::string(command) + " --help");
    CHECK(help.exit_code == 0);
    CHECK_THAT(help.text,
               Contains("Usage: flexneck " + std::string(command)) && Contains("--verbose"));
    CHECK(longest_line(help.text) <= 100);
  }
  CHECK_THAT(run_flexneck("mesh --help").text, Contains("--dry-run") && !Contains("--force"));
}

TEST_CASE("an option is refused by commands in which it does nothing") {
  check_refused(run_flexneck("modes --show"), "--show is an option of the command mesh");
  check_refused(run_flexneck("static --refine=1"),
                "--refine is an option of the command run, qualify, mesh");
  check_refused(run_flexneck("info --set a=1 b"),
                "--set is an option of the command run, qualify, mesh");
  check_refused(run_flexneck("mesh --to bar.inp"), "--to is an option of the command export");
  check_refused(run_flexneck("export --binary --to bar.inp"), "no effect on a file of type .inp");
  check_refused(run_flexneck("mesh --shw"), "'flexneck mesh --help' lists its options");
  check_refused(run_flexneck("mesh --shw"), "--shw (did you mean '--show'?)");
  check_refused(run_flexneck("run --frce"), "(did you mean '--force'?)");
  check_refused(run_flexneck("-o out mesh"),
                "the command must precede its options and files: 'flexneck mesh'");
  check_refused(run_flexneck("-q"), "'flexneck COMMAND' followed by its options");
  check_refused(run_flexneck("msh"), "did you mean 'mesh'?");
}

TEST_CASE("a folder remembers its study and the values set, and a run fits the console") {
  const TemporaryFolder folder;
  const std::string out = " -o " + (folder / "out").string();
  const CommandOutcome run = printed_by(
      folder, std::string("run") + testing::kCoarseNeck + " --set pendulum.duration='0.2 s'");
  CHECK(longest_line(run.text) <= 100);
  CHECK_THAT(run.text, Contains("torsion 2") && Contains("flexion-60 ") &&
                           !Contains("flexion-60-rigid") && Contains("without a verdict"));
  for (const char* const command :
       {"study", "info out/modes.h5", "info out/mesh.h5", "info out/pendulum-flexion-20.h5",
        "compare out out -o beside", "verify -v", "keys study.variant"}) {
    INFO(command);
    const CommandOutcome outcome = printed_by(folder, command);
    CHECK(outcome.exit_code <= 1);  // 1 because of the coarse mesh's frequencies
    CHECK(longest_line(outcome.text) <= 100);
  }
  const CommandOutcome whole = printed_by(folder, "verify -v");
  CHECK_THAT(whole.text, Contains("effective damping"));

  const CommandOutcome modes = run_flexneck("modes --keep --set modes.count=8" + out);
  INFO(modes.text);
  CHECK(modes.exit_code == 0);
  CHECK_THAT(modes.text,
             Contains("Study of " + (folder / "out").string() + ": the built-in one --set mesh."));
  // Runs of the previous modes are neither shown nor judged together with the new ones.
  CHECK_THAT(run_flexneck("report" + out).text,
             Contains("files of this folder, not made from the current modes.h5, are omitted"));
  const CommandOutcome judged = run_flexneck("verify" + out);
  CHECK(judged.exit_code == 2);
  CHECK_THAT(judged.text, Contains("was made from a different modes.h5 than the one in this "
                                   "folder; make it again with 'flexneck pendulum'"));
  const CommandOutcome tester = run_flexneck("static" + out);
  CHECK(tester.exit_code == 0);
  CHECK_THAT(tester.text, Contains("--set modes.count=8"));
  // A study given by name is used as it is.
  check_refused(run_flexneck("static " + std::string(FLEXNECK_SOURCE_DIR) +
                             "/pipeline/data/studies/hybrid3.toml" + out),
                "was made with");
  // Modes of the previous mesh, and all results made from them, are not shown either.
  REQUIRE(run_flexneck("mesh --set mesh.quadrant=3" + out).exit_code == 0);
  CHECK_THAT(
      run_flexneck("report" + out).text,
      Contains("A file of this folder, not made from the current mesh.h5, is omitted: modes.h5;") &&
          Contains("not made from the current modes.h5, are omitted"));
  std::ofstream(folder / "out/study.json") << "{ half a";
  check_refused(run_flexneck("static" + out), "out/study.json: expected the record of the study");
}

TEST_CASE("paths that the system or a folder's study.json cannot take are unusable input") {
  const TemporaryFolder folder;
  const fs::path here = folder.path();
  const std::string out = " -o " + (here / "out").string();
  const std::string shipped = std::string(FLEXNECK_SOURCE_DIR) + "/geometry/examples/";
  const std::string name(300, 'a');
  for (const std::string& command :
       {"mesh cantilever -o " + name, "run cantilever -o " + name, "info " + name,
        "modes -o " + name, "rate " + name + " " + name, "compare " + name + " " + name})
    check_refused(run_flexneck(command), name);
  check_refused(run_flexneck("info " + name), "a name has at most 255 bytes");
  // Invalid UTF-8 is found before any computation: a whole name, one in a folder, one beside this
  // one.
  for (const char* const bytes : {"st\xff\xfe", "b\xe4r", "\xc3", "\xed\xa0\x80"}) {
    fs::create_directories(here / bytes);
    fs::copy_file(shipped + "cantilever.toml", here / bytes / "cantilever.toml");
    fs::copy_file(shipped + "cantilever.geo", here / bytes / "cantilever.geo");
    check_refused(run_flexneck("mesh '" + (here / bytes / "cantilever.toml").string() + "'" + out),
                  "expected a path in UTF-8");
    CHECK_FALSE(fs::exists(here / "out/mesh.h5"));
    // Such a folder can hold a study, which can be named from within.
    const auto inside =
        testing::run_shell("cd '" + (here / bytes).string() + "' && " + FLEXNECK_BINARY_DIR +
                           "/flexneck mesh -q cantilever.toml -o new 2>&1");
    INFO(inside.text);
    CHECK(inside.exit_code == 0);
    CHECK(fs::exists(here / bytes / "new/study.json"));
  }
}

TEST_CASE("no built-in study is taken for results whose study.json is missing") {
  const TemporaryFolder folder;
  const std::string out = " -o " + (folder / "out").string();
  REQUIRE(run_flexneck("mesh -q cantilever" + out).exit_code == 0);
  REQUIRE(run_flexneck("modes -q" + out).exit_code == 0);
  fs::remove(folder / "out/study.json");
  for (const char* const command : {"modes", "pendulum", "static", "verify", "report", "stress"})
    check_refused(run_flexneck(command + out),
                  "study.json, which records the study of these results, is missing; name");
  CHECK(run_flexneck("modes -q cantilever" + out).exit_code == 0);
  CHECK(run_flexneck("modes -q" + out).exit_code == 0);
}

TEST_CASE(
    "a value set for a stage holds for that command alone, which says so, unless it is kept") {
  const TemporaryFolder folder;
  const std::string out = " -o " + (folder / "out").string();
  const std::string study = std::string(FLEXNECK_SOURCE_DIR) + "/geometry/examples/cantilever.toml";
  const auto modes = [&](const std::string& more) {
    const CommandOutcome outcome = run_flexneck("modes " + more + out);
    INFO(outcome.text);
    CHECK(outcome.exit_code == 0);
    return outcome.text;
  };
  REQUIRE(run_flexneck("mesh -q --set modes.count=5 " + study + out).exit_code == 0);
  CHECK_THAT(
      modes("--set modes.count=3"),
      Contains("Solving for 3 modes") && Contains("Only for this command: --set modes.count=3; add "
                                                  "--keep to store it for later commands in " +
                                                  (folder / "out").string() + ", too"));
  CHECK_THAT(modes(""), Contains("Solving for 5 modes") && !Contains("alone"));
  CHECK_THAT(modes(study), Contains("Only for this command: ") && Contains("cantilever.toml"));
  CHECK_THAT(modes("--check"), Contains("command: --set modes.check=true"));
  CHECK_THAT(modes("--set modes.count=3 --keep"), !Contains("alone"));
  CHECK_THAT(modes("--set modes.count=3"), Contains("Solving for 3 modes") && !Contains("alone"));
  CHECK_THAT(modes(""), Contains("Solving for 3 modes"));
  check_refused(run_flexneck("mesh --keep" + out),
                "--keep is an option of the command modes, stress");
}

TEST_CASE("studies and models point at the command that takes them, and a model at what it needs") {
  const TemporaryFolder folder;
  const std::string out = " -o " + (folder / "out").string();
  check_refused(run_flexneck("run four_bar" + out),
                "four_bar.toml: expected a study, found a model; try 'flexneck simulate");
  check_refused(run_flexneck("simulate cantilever" + out),
                "cantilever.toml: expected a model, found a study; try 'flexneck run");
  // Errors in a study of the right kind are reported as usual.
  check_refused(run_flexneck("run cantilever --set modes.cont=4" + out), "did you mean 'count'?");
  check_refused(run_flexneck("simulate four_bar --set solver.end_tim='1 s'" + out),
                "did you mean 'end_time'?");
  check_refused(told_by(folder, "simulate chain"),
                "out/seat_back/modes.h5: no such file, and none in the current folder; make "
                "out/seat_back/modes.h5 with 'flexneck run seat_back -o out/seat_back'");
  CHECK_FALSE(fs::exists(folder / "out"));
  // Paths are relative to the current folder, into which commands write.
  REQUIRE(printed_by(folder, "run -q cantilever -o out/bar").exit_code == 0);
  std::ofstream(folder / "out/bar/swing.toml") << R"(
[solver]
end_time = "1 ms"
[[body]]
name = "bar"
kind = "deformable"
position = ["0 m", "0 m", "0 m"]
damping_ratio = 0
modes_file = "out/bar/modes.h5"
made_by = "flexneck run cantilever -o out/bar"
)";
  const CommandOutcome swing = told_by(folder, "simulate out/bar/swing.toml -o out");
  INFO(swing.text);
  CHECK(swing.exit_code == 0);
}

TEST_CASE("a folder of results is described, and one without results has no report") {
  const TemporaryFolder folder;
  check_refused(
      told_by(folder, "report -o none"),
      "none: contains no results; 'flexneck run -o none' creates those of the built-in study");
  CHECK_FALSE(fs::exists(folder / "none"));
  check_refused(told_by(folder, "info ."), "expected a folder of results");
  REQUIRE(printed_by(folder, "run -q cantilever -o bar").exit_code == 0);
  const CommandOutcome told = printed_by(folder, "info bar");
  CHECK(told.exit_code == 0);
  CHECK(longest_line(told.text) <= 100);
  CHECK_THAT(told.text, Contains("geometry/examples/cantilever.toml") && Contains("modes.h5") &&
                            Contains("flexneck modal body") && Contains("report.html"));
}

TEST_CASE("the study that a folder remembers is found from everywhere, through links too") {
  const TemporaryFolder folder;
  fs::create_directories(folder / "studies");
  fs::create_directories(folder / "far/away");
  std::ofstream(folder / "studies/mine.toml")
      << "include = [\"" << FLEXNECK_SOURCE_DIR << "/geometry/examples/cantilever.toml\"]\n";
  fs::create_directory_symlink(folder / "far/away", folder / "link");
  const std::string made = " -o " + (folder / "link").string();
  const std::string study = (folder / "studies/mine.toml").string();
  REQUIRE(run_flexneck("mesh -q " + study + made + " --set modes.count=3").exit_code == 0);
  const std::string shell = "(cd " + (folder / "far").string() + "; " + testing::flexneck_program();
  for (const char* const place : {"away", "../link"}) {
    const CommandOutcome outcome = testing::run_shell(shell + " modes -o " + place + ")");
    INFO(outcome.text);
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.text, Contains("studies/mine.toml --set modes.count=3") &&
                                 Contains("Solving for 3 modes"));
  }
  fs::remove(folder / "studies/mine.toml");
  CHECK_THAT(run_flexneck("modes" + made).text, Contains("mine.toml"));
  CHECK(run_flexneck("modes" + made).exit_code == 2);
}

}  // namespace flexneck::pipeline
