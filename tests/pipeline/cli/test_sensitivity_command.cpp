// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "fe_modal/body/modal_body_file.h"
#include "geometry/foundation/input_file.h"
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

const std::string kCoarse = testing::kCoarseNeck;
const std::string kSource = FLEXNECK_SOURCE_DIR;

std::size_t longest_line_but_warnings(const std::string& text) {
  std::istringstream lines(text);
  std::size_t longest = 0;
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with("Warning: ")) longest = std::max(longest, line.size());
  return longest;
}

/// Results in a folder: frequencies by name, those with the head, stiffnesses at the top, mass.
std::map<std::string, double> results_in(const fs::path& folder) {
  const fe_modal::ModalBody body = fe_modal::read_modal_body(folder / "modes.h5").body;
  std::map<std::string, double> values = {{"mass", body.invariants.mass}};
  for (std::size_t k = 0; k < body.modes.size(); ++k)
    values[body.modes[k].name] = body.frequencies_Hz[static_cast<Eigen::Index>(k)];
  for (Eigen::Index k = 0; k < 3; ++k)
    values["head on top " + std::to_string(k + 1)] = body.attached.at(0).frequencies_Hz[k];
  const Eigen::Vector<double, 6> stiffness =
      body.interface("top").response->compliance.diagonal().cwiseInverse();
  values["Fx/ux at top"] = stiffness[0];
  values["My/ry at top"] = stiffness[4];
  return values;
}

struct Derivative {
  double input = 0;
  std::string unit;
  double value = 0;
};

/// Derivatives by an input, by the names of the quantities.
std::map<std::string, Derivative> derivatives_by(const fs::path& file, const std::string& input) {
  const auto json = nlohmann::json::parse(text_of_file(file));
  std::map<std::string, Derivative> found;
  for (const auto& row : json.at("tables").back().at("rows")) {
    const auto cell = [&](std::size_t k) { return row.at(k).get<std::string>(); };
    if (cell(5) != input || cell(1) == "mean" || cell(1) == "directional") continue;
    found[cell(0)] = {std::stod(cell(6)), cell(7) == "1" ? "" : " " + cell(7), std::stod(cell(8))};
  }
  return found;
}

std::string text(double value) {
  std::ostringstream stream;
  stream.precision(17);
  stream << value;
  return stream.str();
}

}  // namespace

TEST_CASE("modes --sensitivity gives the derivatives that repeated runs have") {
  constexpr double kDifferences = 1e-5;
  constexpr double kStep = 5e-4;
  const TemporaryFolder folder;
  const fs::path base = folder / "base";
  const std::string out = " -o " + base.string();
  REQUIRE(run_flexneck("mesh -q" + kCoarse + out).exit_code == 0);
  const CommandOutcome outcome = run_flexneck("modes --sensitivity" + out);
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.text, Contains("geometry.bottom_rubber_diameter") &&
                               Contains("geometry.materials.butyl.poissons_ratio") &&
                               Contains("geometry.bolt_circle_radius is omitted"));
  CHECK(longest_line_but_warnings(outcome.text.substr(outcome.text.find("Sensitivities:"))) <= 100);
  const std::string file = text_of_file(base / "sensitivities.json");
  CHECK_THAT(file, Contains("\"flexneck tables\"") && Contains("\"modes.h5\""));

  const auto values = results_in(base);
  for (const std::string key :
       {"geometry.length", "geometry.bottom_rubber_offset",
        "geometry.materials.butyl.poissons_ratio", "geometry.materials.aluminium.density"}) {
    const auto found = derivatives_by(base / "sensitivities.json", key);
    REQUIRE(found.size() >= values.size());
    const Derivative any = found.begin()->second;
    const auto at = [&](double steps) {
      const fs::path moved = folder / "moved";
      const std::string to = " -o " + moved.string();
      const std::string value = text(any.input * (1 + kStep * steps)) + any.unit;
      REQUIRE(
          run_flexneck("mesh -q" + kCoarse + to + " --set '" + key + "=" + value + "'").exit_code ==
          0);
      REQUIRE(run_flexneck("modes -q" + to).exit_code == 0);
      return results_in(moved);
    };
    const auto below = at(-1);
    const auto above = at(1);
    for (const auto& [name, value] : values) {
      INFO(key << ": " << name);
      const double expected = (above.at(name) - below.at(name)) / (2 * kStep * any.input);
      CHECK(std::abs(found.at(name).value - expected) * any.input < kDifferences * value);
    }
  }

  REQUIRE(run_flexneck("report -q" + out).exit_code == 0);
  CHECK_THAT(text_of_file(base / "report.html"), Contains("Sensitivities to the inputs") &&
                                                     Contains("alt=\"Picture: Effect of a change"));
  CHECK(fs::exists(base / "figures/tornado.svg"));
  // Sensitivities are valid only for the modes with which they were made.
  REQUIRE(run_flexneck("modes -q" + out).exit_code == 0);
  CHECK_FALSE(fs::exists(base / "sensitivities.json"));
  REQUIRE(run_flexneck("report -q" + out).exit_code == 0);
  CHECK_FALSE(fs::exists(base / "figures/tornado.svg"));
}

TEST_CASE("of a script's constants those have sensitivities that move nodes") {
  const TemporaryFolder folder;
  const std::string out = " -o " + folder.path().string();
  REQUIRE(
      run_flexneck("mesh -q " + kSource + "/geometry/examples/cantilever.toml" + out).exit_code ==
      0);
  const CommandOutcome outcome = run_flexneck("modes --sensitivity" + out);
  INFO(outcome.text);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.text,
             Contains("geometry.constants.along is omitted: it changes the topology"));
  // A slender bar: f ~ length^-2, sqrt(E / rho).
  const auto by = [&](const std::string& key) {
    const Derivative found = derivatives_by(folder / "sensitivities.json", key).at("mode 1");
    const fe_modal::ModalBody body = fe_modal::read_modal_body(folder / "modes.h5").body;
    return found.value * found.input / body.frequencies_Hz[0];
  };
  CHECK(by("geometry.constants.length") == Approx(-2).margin(0.005));
  CHECK(by("geometry.materials.aluminium.youngs_modulus") == Approx(0.5).epsilon(1e-7));
  CHECK(by("geometry.materials.aluminium.density") == Approx(-0.5).epsilon(1e-7));
}

TEST_CASE("a mesh from a file has sensitivities to its materials only") {
  const TemporaryFolder folder;
  const std::string out = " -o " + folder.path().string();
  REQUIRE(run_flexneck("mesh -q " + kSource + "/geometry/examples/cantilever_msh.toml" + out)
              .exit_code == 0);
  const CommandOutcome outcome = run_flexneck("modes --sensitivity" + out);
  INFO(outcome.text);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.text, Contains("a mesh from a file has no dimensions, only materials") &&
                               Contains("aluminium.youngs_modulus  +0.500"));
}

TEST_CASE("the option --sensitivity is refused where it cannot be") {
  const TemporaryFolder folder;
  const std::string out = " -o " + folder.path().string();
  check_refused(run_flexneck("run --sensitivity" + out),
                "--sensitivity is an option of the command modes, not of 'run'");
  check_refused(run_flexneck("modes --sensitivity --set modes.basis=craig-bampton" + out),
                "needs eigenvectors, found modes.basis = \"craig-bampton\"");
  std::ofstream(folder / "matrices.toml")
      << "[matrices]\nstiffness = \"K.mtx\"\nmass = \"M.mtx\"\nnodes = \"x.txt\"\n";
  for (const char* const name : {"K.mtx", "M.mtx", "x.txt"}) std::ofstream(folder / name) << "\n";
  check_refused(run_flexneck("modes --sensitivity " + (folder / "matrices.toml").string() + out),
                "which [matrices] does not contain");
}

}  // namespace flexneck::pipeline
