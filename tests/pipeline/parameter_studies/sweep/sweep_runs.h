// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/foundation/temporary_folder.h"
#include "tests/support/beam_study.h"
#include "tests/support/files.h"
#include "tests/support/flexneck_command.h"

namespace flexneck::testing {

inline const std::string kHypercube = R"([sweep]
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

inline std::string sweep(const std::filesystem::path& study, const std::filesystem::path& out,
                         const std::string& more = "") {
  return "sweep " + study.string() + " -o " + out.string() + " " + more;
}

inline void require_done(const std::string& arguments) {
  const CommandOutcome outcome = run_flexneck(arguments);
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
}

/// The files of a table, concatenated.
inline std::string table_in(const std::filesystem::path& out) {
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
inline std::string small_sweep(const std::string& parameter,
                               const std::string& outputs = R"("pendulum.flexion.head_rotation")",
                               const std::string& plan = "plan = \"grid\"") {
  return "[sweep]\n" + plan + "\noutputs = [" + outputs + "]\n[[sweep.parameter]]\n" + parameter;
}

inline CommandOutcome outcome_of(const std::string& section) {
  const TemporaryFolder folder;
  return run_flexneck(sweep(write_beam_study(folder.path(), section), folder / "out"));
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace flexneck::testing
