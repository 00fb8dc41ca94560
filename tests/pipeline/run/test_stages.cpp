// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include <catch2/catch.hpp>

#include "geometry/foundation/files_read.h"
#include "geometry/foundation/input_file.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/temporary_folder.h"
#include "pipeline/run/results_folder.h"
#include "pipeline/run/stages.h"

namespace flexneck::pipeline {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }

Provenance from(const std::string& value) {
  Provenance provenance;
  provenance.parameters = {{"length", value, Origin::synthetic, ""}};
  return provenance;
}

/// Runs two stages, the second with the first's output; returns which of them ran.
std::string run(const fs::path& folder, const std::string& length, const std::string& mass,
                bool redo = false) {
  Stages stages(folder, redo);
  std::string ran;
  const auto first = [&] {
    ran += "first ";
    write(folder / "one.txt", "long: " + std::to_string(length.size()));
    fs::create_directories(folder / "more");
    write(folder / "more" / "two.txt", "always the same");
  };
  const auto second = [&] {
    ran += "second";
    write(folder / "three.txt", mass);
  };
  stages.make("first", from(length), {}, first);
  stages.make("second", from(mass), {"first"}, second);
  return ran;
}

}  // namespace

TEST_CASE("a stage runs if what it is made from or what it wrote has changed, else not") {
  const TemporaryFolder folder;
  CHECK(run(folder.path(), "2 m", "5 kg") == "first second");
  CHECK(run(folder.path(), "2 m", "5 kg").empty());
  CHECK(run(folder.path(), "2 m", "6 kg") == "second");
  // With another length the first stage writes the same: the second need not run.
  CHECK(run(folder.path(), "3 m", "6 kg") == "first ");
  CHECK(run(folder.path(), "10 m", "6 kg") == "first second");
  CHECK(run(folder.path(), "10 m", "6 kg", true) == "first second");

  fs::remove(folder / "more" / "two.txt");
  CHECK(run(folder.path(), "10 m", "6 kg") == "first ");
  write(folder / "three.txt", "by hand");
  CHECK(run(folder.path(), "10 m", "6 kg") == "second");
  write(folder / "of_the_user.txt", "which no stage wrote");
  CHECK(run(folder.path(), "10 m", "6 kg").empty());
  write(folder / "stages.json", "{ half a");
  CHECK(run(folder.path(), "10 m", "6 kg") == "first second");
}

TEST_CASE(
    "a stage runs again if a file that it has read has changed, gone or come, and warns again") {
  const TemporaryFolder results;
  const fs::path inputs = results / "inputs";
  fs::create_directories(inputs);
  const fs::path input = inputs / "table.csv";
  const auto runs = [&] {
    Stages stages(results.path(), false);
    const bool ran = stages.make("only", from("1"), {}, [&] {
      if (fs::exists(input)) write(results / "one.txt", text_of_file(input));
      note_read(inputs / "may_come.csv");
      {
        const TemporaryFolder passing;
        write(passing / "own.txt", "of the stage alone");
        CHECK_FALSE(text_of_file(passing / "own.txt").empty());
      }
      stages.add_warning("table: rough");
    });
    CHECK(stages.warnings("only") == std::vector<std::string>{"table: rough"});
    return ran;
  };
  write(inputs / "a.csv", "1");
  write(inputs / "b.csv", "2");
  fs::create_symlink("a.csv", input);
  CHECK(runs());
  CHECK_FALSE(runs());
  write(inputs / "a.csv", "3");
  CHECK(runs());
  fs::remove(input);
  fs::create_symlink("b.csv", input);
  CHECK(runs());
  CHECK_FALSE(runs());
  write(inputs / "may_come.csv", "there");
  CHECK(runs());
  fs::remove(input);
  CHECK(runs());
}

TEST_CASE("a stage that reads what nobody knows is made each time") {
  const TemporaryFolder folder;
  for (int k = 0; k < 2; ++k) {
    Stages stages(folder.path(), false);
    CHECK(stages.make("only", from("1"), {}, [&] { note_unknown_reads(folder / "script.geo"); }));
  }
}

TEST_CASE("files of one name in several folders are told apart") {
  const TemporaryFolder folder;
  const auto hash_with = [&](const std::string& middle) {
    const char* const names[] = {"a", "b", "c"};
    const std::string texts[] = {"1", middle, "2"};
    std::string hashes;
    const FilesRead reads;
    for (std::size_t k = 0; k < 3; ++k) {
      fs::create_directories(folder / names[k]);
      write(folder / names[k] / "pulse.csv", texts[k]);
      text_of_file(folder / names[k] / "pulse.csv");
    }
    for (const InputFile& file : input_files(reads.files())) hashes += file.name + file.hash;
    return hashes;
  };
  CHECK(hash_with("1") != hash_with("2"));
}

TEST_CASE("a result of a stage before is refused once a file that it was made from is another") {
  const TemporaryFolder folder;
  Study study;
  study.parameters = from("2 m").parameters;
  study.defaults = study.parameters;
  Provenance mesh = from("2 m");
  mesh.program = "flexneck";
  mesh.parameters.clear();
  const auto check = [&](const std::string& other) {
    const auto look = [&] { require_same_inputs("mesh.h5", mesh, study, {}, "flexneck mesh"); };
    if (other.empty())
      CHECK_NOTHROW(look());
    else
      CHECK_THROWS_WITH(look(), "mesh.h5: was made from a different " + other +
                                    " than the current one; make it again with 'flexneck mesh'");
  };
  SECTION("what a script includes") {
    write(folder / "part.geo", "W = 1;");
    write(folder / "bar.geo", "Include \"part.geo\";");
    mesher::ScriptMeshOptions script;
    script.script = folder / "bar.geo";
    study.structure.emplace();
    study.structure->source = script;
    mesh.inputs = {{"bar.geo", hash_now(folder / "bar.geo")},
                   {"part.geo", hash_now(folder / "part.geo")}};
    check("");
    write(folder / "part.geo", "W = 2;");
    check("part.geo");
    fs::remove(folder / "part.geo");  // a moved folder's inputs cannot be checked
    check("");
    // A script that runs commands may write it.
    write(folder / "bar.geo", "SystemCall \"make\"; Include \"part.geo\";");
    write(folder / "part.geo", "W = 3;");
    check("");
  }
  SECTION("a matrix, and a table") {
    for (const char* const name : {"K.mtx", "M.mtx", "nodes.mtx"}) {
      write(folder / name, name);
      mesh.inputs.push_back({name, hash_now(folder / name)});
    }
    study.matrices = MatricesSection{folder / "K.mtx", folder / "M.mtx", folder / "nodes.mtx"};
    study.tables = {{"pulse.csv", "1"}};
    check("");
    mesh.inputs.push_back({"pulse.csv", "1"});
    check("");
    write(folder / "M.mtx", "4 M");
    check("M.mtx");
    write(folder / "M.mtx", "M.mtx");
    study.tables = {{"pulse.csv", "2"}};
    check("pulse.csv");
  }
}

TEST_CASE("a stage that was stopped is made again, those before it are kept") {
  const TemporaryFolder folder;
  int first = 0;
  int second = 0;
  bool stops = true;
  const auto run_both = [&] {
    Stages stages(folder.path(), false);
    stages.make("first", from("1"), {}, [&] {
      ++first;
      write(folder / "one.txt", "one");
    });
    stages.make("second", from("2"), {"first"}, [&] {
      ++second;
      write(folder / "two.txt", "half");
      if (stops) throw std::runtime_error("stopped");
    });
  };
  CHECK_THROWS_WITH(run_both(), "stopped");
  stops = false;
  run_both();
  run_both();
  CHECK(first == 1);
  CHECK(second == 2);
}

TEST_CASE("a case is made from its own values, those of the case it varies and of what it names") {
  const Study study = read_study(built_in_study(), {});
  const auto has = [&](const std::string& name, const std::string& prefix) {
    const CaseSection& experiment = study.cases[find_name(names_of(study.cases), name, "case")];
    const Provenance provenance = case_provenance(study, experiment);
    return std::any_of(
        provenance.parameters.begin(), provenance.parameters.end(),
        [&](const Parameter& parameter) { return parameter.key.starts_with(prefix); });
  };
  for (const char* const own :
       {"case.flexion-60.", "variant.spring.", "variant.spring.resistance.nodding.",
        "pulse.flexion.", "pendulum.", "body.neck.", "solver.", "output."}) {
    INFO(own);
    CHECK(has("flexion-60-spring", own));
  }
  for (const char* const other :
       {"case.flexion-20.", "case.flexion.", "variant.rigid.", "variant.equivalent.",
        "pulse.extension.", "force.", "static.", "geometry.", "modes."}) {
    INFO(other);
    CHECK_FALSE(has("flexion-60-spring", other));
  }
  CHECK(has("extension-60-rigid", "variant.rigid.body.neck."));
  CHECK_FALSE(has("extension-60-rigid", "variant.rigid-lateral."));
  CHECK(has("lateral-65-rigid", "variant.rigid-lateral."));
  CHECK_FALSE(has("flexion-60", "variant."));
  CHECK(has("flexion", "force.forward load."));
  CHECK_FALSE(has("flexion", "force.rearward load."));
}

}  // namespace flexneck::pipeline
