// SPDX-License-Identifier: GPL-3.0-or-later
// Fits of a study whose runs take milliseconds, and the files they write.
#pragma once

#include <filesystem>
#include <string>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/foundation/temporary_folder.h"
#include "pipeline/process/console.h"
#include "tests/support/beam_study.h"
#include "tests/support/files.h"
#include "tests/support/flexneck_command.h"

namespace flexneck::testing {

inline std::string fit(const std::filesystem::path& study, const std::filesystem::path& out,
                       const std::string& more = "") {
  return "fit " + study.string() + " -o " + out.string() + " " + more;
}

inline CommandOutcome require_done(const std::string& arguments) {
  CommandOutcome outcome = run_flexneck(arguments);
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
  return outcome;
}

inline nlohmann::json table_in(const std::filesystem::path& out, const std::string& name) {
  const nlohmann::json file = nlohmann::json::parse(bytes_of(out / "fit.json"));
  for (const nlohmann::json& table : file.at("tables"))
    if (table.at("name") == name) return table;
  FAIL("no table " + name);
  return {};
}

inline double cell(const nlohmann::json& table, std::size_t row, std::size_t column) {
  return std::stod(table.at("rows").at(row).at(column).get<std::string>());
}

/// Text of a study with the bar's material, which the deck has too.
inline const std::string kRubber =
    "[geometry.materials.Rubber]\nyoungs_modulus = \"70 MPa\"\npoissons_ratio = 0.3\n"
    "density = \"3000 kg/m^3\"\nparts = [\"BAR\"]\n";
inline const std::string kModulus =
    "[[fit.parameter]]\nname = \"E\"\nkey = \"geometry.materials.Rubber.youngs_modulus\"\n"
    "unit = \"MPa\"\nfrom = 30\nto = 150\n";
inline const std::string kMass =
    "[[fit.parameter]]\nname = \"head\"\nkey = \"body.head.mass\"\nunit = \"kg\"\nfrom = 3\n"
    "to = 6\nstart = 5.5\n";

/// Text of a target: the bar's frequency at 70 MPa, and the first one with the head.
inline std::string target(const std::string& output, const std::string& value,
                          const std::string& more = "relative_deviation = 0.001\n") {
  return "[[fit.target]]\nname = \"" + output + "\"\noutput = \"" + output + "\"\nvalue = \"" +
         value + "\"\n" + more;
}

/// The console of the process, which may have only one.
inline const pipeline::Console& quiet_console() {
  static const pipeline::Console console(pipeline::Verbosity::quiet);
  return console;
}

inline CommandOutcome outcome_of(const std::string& section) {
  const TemporaryFolder folder;
  return run_flexneck(fit(write_beam_study(folder.path(), section), folder / "out"));
}

}  // namespace flexneck::testing
