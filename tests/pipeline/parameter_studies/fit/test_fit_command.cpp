// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of 'flexneck fit' on a study whose runs take milliseconds.
#include <cmath>
#include <fstream>

#include <catch2/catch.hpp>

#include "geometry/foundation/temporary_folder.h"
#include "tests/pipeline/parameter_studies/fit/fit_runs.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::testing;
namespace fs = std::filesystem;

namespace {

/// An output of a sweep of the study with other values.
double figure_of(const fs::path& folder, const std::string& output, const std::string& settings) {
  const fs::path study = write_beam_study(
      folder, kRubber + "[sweep]\noutputs = [\"" + output +
                  "\"]\n[[sweep.parameter]]\nkey = \"output.interval\"\nunit = \"ms\"\n"
                  "values = [2.5]\n");
  const fs::path out = folder / "truth";
  fs::remove_all(out);
  require_done("sweep " + study.string() + " -o " + out.string() + " " + settings);
  const std::string csv = bytes_of(out / "sweep.csv");
  const std::string line = csv.substr(csv.find('\n') + 1);
  const std::size_t first = line.find(',', line.find(',') + 1) + 1;
  return std::stod(line.substr(first));
}

}  // namespace

TEST_CASE("a fit finds a modulus by a frequency, and the fitted study has it") {
  const TemporaryFolder folder;
  const auto at = [&](const std::string& modulus) {
    return figure_of(folder.path(), "pendulum.flexion.system_frequency",
                     "--set geometry.materials.Rubber.youngs_modulus='" + modulus + "'");
  };
  const double wanted = at("95 MPa");
  const fs::path study = write_beam_study(
      folder.path(),
      kRubber + "[fit]\nstarts = 3\n" + kModulus +
          target("pendulum.flexion.system_frequency", std::to_string(wanted) + " Hz"));
  const CommandOutcome outcome = require_done(fit(study, folder / "out"));
  CHECK_THAT(outcome.text, Contains("Unique within the bounds, as far as 3 starts show"));
  const nlohmann::json parameters = table_in(folder / "out", "fit parameters");
  CHECK(cell(parameters, 0, 2) == Approx(95).epsilon(1e-4));
  // The slope follows from the frequencies 1 MPa below and above.
  const double slope = (at("96 MPa") - at("94 MPa")) / 2;
  const double half = 0.5 * (cell(parameters, 0, 4) - cell(parameters, 0, 3));
  CHECK(half == Approx(1.96 * 0.001 * wanted / slope).epsilon(0.01));
  const std::string fitted = bytes_of(folder / "out/fitted.toml");
  CHECK_THAT(fitted, Contains("calibrated") && Contains("study.toml"));
  // The fitted study gives the target, and its value has its origin.
  const CommandOutcome inputs = require_done("study " + (folder / "out/fitted.toml").string() +
                                             " -o " + (folder / "again").string());
  CHECK_THAT(inputs.text, Contains("calibrated"));
}

TEST_CASE("closed-form slopes and differences come to the same fit") {
  const TemporaryFolder folder;
  const double wanted = figure_of(folder.path(), "modes.system_frequency", "");
  // Derivatives of the modes' results are in closed form; not for another basis, nor if there are
  // pendulum outputs among the targets, unless these are held out.
  const std::string of_modes = kRubber + "[fit]\nstarts = 1\n" + kModulus +
                               target("modes.system_frequency", std::to_string(wanted) + " Hz");
  const fs::path study = write_beam_study(folder.path(), of_modes);
  CHECK_THAT(require_done(fit(study, folder / "closed")).text, Contains("in closed form"));
  CHECK_THAT(
      require_done(fit(study, folder / "differences", "--set modes.basis=craig-bampton")).text,
      Contains("derivatives by finite differences"));
  const std::string rotation =
      target("pendulum.flexion.head_rotation", "20 deg", "standard_deviation = \"1000 deg\"\n");
  CHECK_THAT(
      require_done(fit(write_beam_study(folder.path(), of_modes + rotation), folder / "mixed"))
          .text,
      Contains("in closed form for modes, otherwise by finite differences"));
  CHECK_THAT(
      require_done(fit(write_beam_study(folder.path(), of_modes + rotation + "held_out = true\n"),
                       folder / "held-out"))
          .text,
      Contains("derivatives in closed form"));
  const nlohmann::json one = table_in(folder / "closed", "fit parameters");
  for (const char* const way : {"differences", "mixed", "held-out"}) {
    const nlohmann::json other = table_in(folder / way, "fit parameters");
    for (std::size_t column : {2U, 3U, 4U})
      CHECK(cell(one, 0, column) == Approx(cell(other, 0, column)).epsilon(1e-4));
  }
  CHECK(table_in(folder / "held-out", "fit targets").at("rows").at(1).at(7) == "held out");
}

TEST_CASE("what no target fixes makes a fit not unique in its first line") {
  // Both modulus and head mass change the single frequency.
  const CommandOutcome outcome = outcome_of(kRubber + "[fit]\nstarts = 2\n" + kModulus + kMass +
                                            target("pendulum.flexion.system_frequency", "5 Hz"));
  INFO(outcome.text);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.text,
             Contains("Not unique: ") && Contains("no target determines the combination of"));
  CHECK_THAT(outcome.text, Contains("The study states no choices"));
}

TEST_CASE("an expression of the parameters is a target, and an inequality between them holds") {
  const TemporaryFolder folder;
  const auto fitted = [&](const std::string& targets) {
    const fs::path study =
        write_beam_study(folder.path(), kRubber + "[fit]\nstarts = 1\nprofiles = false\n" +
                                            kModulus + kMass + targets);
    fs::remove_all(folder / "out");
    require_done(fit(study, folder / "out"));
    const nlohmann::json parameters = table_in(folder / "out", "fit parameters");
    return std::pair(cell(parameters, 0, 2), cell(parameters, 1, 2));
  };
  const auto expression = [](const std::string& text, const std::string& wanted) {
    return "[[fit.target]]\nname = \"of " + std::to_string(text.size()) + "\"\nexpression = \"" +
           text + "\"\n" + wanted;
  };
  // One frequency and a product determine both parameters, and both targets are met.
  const auto [modulus, mass] =
      fitted(target("pendulum.flexion.system_frequency", "2.5 Hz") +
             expression("sqrt(E * head)", "value = \"20\"\nstandard_deviation = \"0.01\"\n"));
  CHECK(std::sqrt(modulus * mass) == Approx(20).margin(1e-3));
  CHECK(cell(table_in(folder / "out", "fit targets"), 0, 2) == Approx(2.5).epsilon(1e-4));
  // The targets are 90 and 5, with the constraint E <= 15 head: the nearest point of that
  // half-plane in units of the deviations, 1 and 0.1, is 90 - a, 5 + 0.15 a with a = 15 / (1 +
  // 2.25).
  const auto [nearest, heavier] =
      fitted(expression("E", "value = \"90\"\nstandard_deviation = \"1\"\n") +
             expression("head", "value = \"5\"\nstandard_deviation = \"0.1\"\n") +
             expression("E - 15 * head", "high = \"0\"\nsmoothing = \"1\"\nmust_hold = true\n") +
             target("modes.mass", "1 kg", "relative_deviation = 0.001\nheld_out = true\n") +
             target("pendulum.flexion.system_frequency", "5 Hz",
                    "relative_deviation = 0.001\nheld_out = true\n"));
  constexpr double kMoved = 15 / (1 + 2.25);
  CHECK(nearest == Approx(90 - kMoved).margin(0.01));
  CHECK(heavier == Approx(5 + 0.15 * kMoved).margin(0.002));
  CHECK(nearest <= 15 * heavier);
}

TEST_CASE("a fit is the same for any threads, and goes on with what is there") {
  const TemporaryFolder folder;
  const fs::path study = write_beam_study(
      folder.path(),
      "[fit]\nstarts = 3\nhistory_samples = 40\nchoices = [\"The case was picked.\"]\n" + kMass +
          "[[fit.parameter]]\nname = \"damping\"\nkey = \"body.neck.damping_ratio\"\nfrom = 0.3\n"
          "to = 1.5\n" +
          target("pendulum.flexion.head_rotation", "17 deg", "standard_deviation = \"1 deg\"\n") +
          "[[fit.target]]\nname = \"time\"\noutput = \"pendulum.flexion.head_rotation_time\"\n"
          "low = \"20 ms\"\nhigh = \"200 ms\"\n");
  require_done(fit(study, folder / "one", "--threads 1"));
  const CommandOutcome two = require_done(fit(study, folder / "two", "--threads 2"));
  CHECK(bytes_of(folder / "one/fit.json") == bytes_of(folder / "two/fit.json"));
  CHECK_THAT(two.text, Contains("Share of the prior that meets the targets"));
  CHECK(table_in(folder / "one", "fit choices").at("rows").at(0).at(0) == "The case was picked.");
  CHECK_THAT(two.text, Contains("Chosen with knowledge of the targets: (1) The case was picked."));
  for (const char* const name : {"fit-targets.svg", "fit-profiles.svg", "fit-history.svg"})
    CHECK_THAT(bytes_of(folder / "one" / name), Contains("</svg>"));
  // A row that was removed is computed again, and the results do not change.
  const std::string whole = bytes_of(folder / "one/fit.json");
  const fs::path rows = folder / "one/fit-rows/starts.txt";
  const std::string text = bytes_of(rows);
  std::ofstream(rows, std::ios::binary) << text.substr(0, text.size() - 30);
  require_done(fit(study, folder / "one"));
  CHECK(bytes_of(folder / "one/fit.json") == whole);
}

TEST_CASE("Ctrl-C keeps the fits that are done") {
  const TemporaryFolder folder;
  const fs::path study = write_beam_study(
      folder.path(),
      "[fit]\nstarts = 1\nprofiles = false\nhistory_samples = 1000000\n" + kMass +
          target("pendulum.flexion.head_rotation", "17 deg", "standard_deviation = \"1 deg\"\n"));
  const CommandOutcome outcome = run_shell("timeout --foreground -s INT 1.5 " + flexneck_program() +
                                           " " + fit(study, folder / "out"));
  INFO(outcome.text);
  CHECK_THAT(outcome.text, Contains("stopped; completed fits are kept"));
  CHECK(bytes_of(folder / "out/fit-rows/history.txt").size() > 100);
  CHECK_FALSE(fs::exists(folder / "out/fit.json"));
}

TEST_CASE("what is wrong with a fit is told in one line") {
  const std::string rotation =
      target("pendulum.flexion.head_rotation", "17 deg", "standard_deviation = \"1 deg\"\n");
  check_refused(outcome_of(""), "expected [fit]");
  check_refused(outcome_of("[fit]\n" + rotation), "fit.parameter: expected at least one");
  check_refused(outcome_of("[fit]\n" + kMass),
                "expected at least one target that contributes to chi-squared");
  check_refused(outcome_of("[fit]\nevaluations = 9\n" + kMass + rotation),
                "has an effect only with method = \"global\"");
  check_refused(outcome_of("[fit]\n" + kMass + rotation + "must_hold = true\n"),
                "expected only for a window or a corridor");
  check_refused(
      outcome_of("[fit]\n[[fit.parameter]]\nname = \"g\"\nkey = \"case.far.impact_velocity\"\n"
                 "unit = \"m/s\"\nfrom = 1\nto = 5\n" +
                 rotation),
      "expected a key that an output depends on, found 'case.far.impact_velocity'");
  check_refused(
      outcome_of(kRubber + "[fit]\n" + kModulus + target("modes.frequency.torsion 9", "3 Hz")),
      "torsion 9");
  check_refused(outcome_of(kRubber + "[fit]\n" + kModulus +
                           target("modes.frequency_by_rank.bending 9", "3 Hz")),
                "increase modes.count");
  check_refused(outcome_of("[fit]\n" + kMass + target("modes.frequency_by_rank.bending", "3 Hz")),
                "kind of mode and its rank");
  check_refused(outcome_of("[fit]\n[[fit.parameter]]\nname = \"m\"\nkey = \"body.head.mass\"\n"
                           "unit = \"kg\"\nfrom = 5\nto = 6\n" +
                           rotation),
                "expected bounds that contain the start");
  check_refused(outcome_of("[fit]\n[[fit.parameter]]\nname = \"m\"\nkey = \"body.head.mass\"\n"
                           "unit = \"kg\"\nfrom = 5\nto = 6\nstart = 7\n" +
                           rotation),
                "expected a value between the bounds from and to");
  check_refused(outcome_of("[fit]\n" + kMass +
                           "[[fit.target]]\noutput = \"pendulum.flexion.head_rotation\"\n"
                           "low = \"20 deg\"\nhigh = \"10 deg\"\n"),
                "expected a value above low");
  check_refused(outcome_of("[fit]\n" + kMass + target("pendulum.flexion.head_rotation", "17 Hz")),
                "rad");
  check_refused(
      outcome_of("[fit]\n" + kMass + rotation +
                 "[[fit.target]]\nname = \"less\"\nexpression = \"head - tail\"\nlow = \"0\"\n"
                 "smoothing = \"1\"\n"),
      "parameters whose names are single words: head");
  check_refused(outcome_of("[fit]\n" + kMass +
                           "[[fit.target]]\nexpression = \"head\"\noutput = \"modes.mass\"\n"),
                "expected exactly one of output, curve and expression");
  check_refused(outcome_of("[fit]\n" + kMass + rotation +
                           "[[fit.target]]\nexpression = \"head\"\nvalue = \"5\"\n"),
                "expected a name for an expression");
  check_refused(
      outcome_of("[fit]\n" + kMass + target("pendulum.flexion.head_rotation", "17 deg", "")),
      "expected exactly one of standard_deviation and relative_deviation");
}

TEST_CASE("a disk that fills up ends a fit with one line, and then it goes on") {
  const TemporaryFolder folder;
  const fs::path study = write_beam_study(
      folder.path(),
      "[fit]\nstarts = 1\nhistory_samples = 200\n" + kMass +
          target("pendulum.flexion.head_rotation", "17 deg", "standard_deviation = \"1 deg\"\n"));
  require_done(fit(study, folder / "whole"));
  // A limit of 2 kB per file simulates a full disk.
  const CommandOutcome outcome = run_shell("sh -c 'ulimit -f 4; exec " + flexneck_program() +
                                           " -q " + fit(study, folder / "full") + "'");
  check_refused(outcome, "cannot be written", 3);
  require_done(fit(study, folder / "full"));
  CHECK(bytes_of(folder / "full/fit.json") == bytes_of(folder / "whole/fit.json"));
}
