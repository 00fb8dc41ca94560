// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of [[test]] of studies, and of the tables of verdicts.
#include <algorithm>
#include <fstream>

#include <catch2/catch.hpp>

#include "geometry/foundation/temporary_folder.h"
#include "geometry/foundation/units.h"
#include "pipeline/experiments/pendulum.h"
#include "pipeline/experiments/test_curves.h"
#include "pipeline/experiments/verdict_tables.h"
#include "pipeline/language/study/study.h"
#include "pipeline/run/results_folder.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::pipeline;
using Eigen::VectorXd;

namespace {

Study built_in(const std::vector<std::string>& settings = {}) {
  return read_study(built_in_study(), settings);
}

const CaseSection& case_named(const Study& study, const std::string& name) {
  return *std::find_if(study.cases.begin(), study.cases.end(),
                       [&](const CaseSection& each) { return each.name == name; });
}

/// Channels that the tests read: linear up to a peak and linear down to zero.
std::vector<multibody::Channel> channels(const VectorXd& time_s, double rotation_rad,
                                         double moment_Nm) {
  const VectorXd shape =
      time_s.unaryExpr([](double t) { return t < 0.06 ? t / 0.06 : 2 - t / 0.06; });
  const auto channel = [&](const char* name, double peak) {
    return multibody::Channel{name, "", {name}, (peak * shape).transpose(), ""};
  };
  return {channel("head rotation", rotation_rad), channel("load cell moment", moment_Nm)};
}

JudgedTest judged_test(const Study& study, std::size_t k, double rotation_rad, double moment_Nm) {
  const TestSection& test = study.tests.at(k);
  const CaseSection& experiment = case_named(study, test.experiment);
  const VectorXd time_s = VectorXd::LinSpaced(401, 0, 0.2);
  const TestCurves curves =
      test_curves(study, test, experiment, time_s, channels(time_s, rotation_rad, moment_Nm));
  return {test, JudgedTest::Status::judged, judged(test.rules, curves),
          moment_difference(test, experiment)};
}

}  // namespace

TEST_CASE("the built-in study is judged in both directions, at the regulation's velocities") {
  const Study study = built_in();
  CHECK(study.dummy == "Hybrid III 50th male");
  REQUIRE(study.tests.size() == 4);
  for (const TestSection& test : study.tests) {
    INFO(test.name);
    CHECK(applies(test, study));
    const CaseSection& experiment = case_named(study, test.experiment);
    CHECK(test.rules.impact_velocity_m_s.contains(experiment.impact_velocity_m_s));
    CHECK(moment_difference(test, experiment).empty());
  }
}

TEST_CASE("the curves of a test have its signs, and its pulse its filter") {
  const Study study = built_in();
  const double deg = factor_from_si("rad", "deg");
  // Head rotation and moment of a case are negative in extension.
  const JudgedTest extension = judged_test(study, 1, -90 / deg, -60);
  REQUIRE(extension.verdict);
  CHECK(*extension.verdict->figures[0].value * deg == Approx(90));
  CHECK(*extension.verdict->figures[3].value == Approx(-60));

  // The case's pulse lies in its corridor; before the impact there is no pulse.
  for (std::size_t k = 0; k < study.tests.size(); ++k)
    CHECK(judged_test(study, k, 1, 1).verdict->unmet_conditions().empty());
  const Eigen::Vector2d time_s(0, 0.2);
  const TestSection& test = study.tests[0];
  const CaseSection& experiment = case_named(study, test.experiment);
  const PulseCurve pulse =
      test_curves(study, test, experiment, time_s, channels(time_s, 1, 1)).pulse;
  double area = 0;
  for (Eigen::Index k = 1; k < pulse.time_s.size(); ++k)
    area += (pulse.time_s[k] - pulse.time_s[k - 1]) *
            (pulse.deceleration_m_s2[k] + pulse.deceleration_m_s2[k - 1]) / 2;
  // The filter preserves the area except for the part that it moves before the contact.
  CHECK(area == Approx(experiment.impact_velocity_m_s).epsilon(2e-3));
  CHECK(pulse.time_s[0] == 0);
  CHECK(pulse.deceleration_m_s2[0] > 0);
  CHECK(pulse.deceleration_m_s2[0] < 4 * kStandardGravity_m_s2);
}

TEST_CASE("a pulse and a velocity outside are warned of and fail nothing") {
  const Study study = built_in({"case.flexion-120.impact_velocity=26.5 ft/s"});
  const JudgedTest test = judged_test(study, 0, 1, 1);
  const std::vector<std::string> warnings = verdict_warnings({test});
  REQUIRE(warnings.size() == 2);
  CHECK_THAT(warnings[0], Contains("test 'flexion', case flexion-120: impact velocity: 26.50 ft/s, "
                                   "3.10 ft/s above 22.60 to 23.40 ft/s"));
  CHECK_THAT(warnings[1], Contains("pulse at 10 ms: ") && Contains(" gn above 22.50 to 27.50 gn"));
  CHECK(test.verdict->figures.size() == 6);
  const ResultTable table = verdict_table({test}, study);
  CHECK(table.rows[0].back() == "velocity and pulse outside");
  CHECK_THAT(table.notes.front(), Contains("Warning: test 'flexion'"));
}

TEST_CASE("tests of other dummies do not apply, unless the study says that it is one") {
  const std::string female = "test.flexion.regulation=572.133 flexion";
  const Study study = built_in({female});
  CHECK_FALSE(applies(study.tests[0], study));
  const ResultTable table =
      verdict_table({{study.tests[0], JudgedTest::Status::not_applicable, {}, ""}}, study);
  CHECK(table.rows[0][3] == "not applicable");
  CHECK(table.notes ==
        std::vector<std::string>{"572.133 flexion is for the dummy 'Hybrid III 5th female', the "
                                 "study's is 'Hybrid III 50th male'."});

  // The difference of its moment is reported, unless the cases compute it as the regulation does.
  const Study small = built_in({female, "dummy.name=Hybrid III 5th female"});
  CHECK(applies(small.tests[0], small));
  CHECK_THAT(judged_test(small, 0, 1, 1).moment_difference,
             Contains("17.678 mm Fx with My of CFC 600 and Fx of CFC 600, the regulation") &&
                 Contains("17.780 mm Fx with My of CFC 600 and Fx of CFC 1000"));
  CHECK_THAT(verdict_warnings({judged_test(small, 0, 1, 1)}).back(),
             Contains("test 'flexion', case flexion-120: the case has M = My - 17.678 mm Fx"));
  const Study formed = built_in({female, "dummy.name=Hybrid III 5th female",
                                 "pendulum.moment_arm=17.78 mm", "pendulum.force_filter=CFC 1000"});
  CHECK(judged_test(formed, 0, 1, 1).moment_difference.empty());
}

TEST_CASE("a line of a verdict tells how many figures are inside and which is furthest") {
  const Study study = built_in();
  const double deg = factor_from_si("rad", "deg");
  // Rotation 71 deg at 60 ms and back at 120; moment 54.2 lbf ft, at 60 ms, decayed at 120.
  const JudgedTest test = judged_test(study, 0, 71 / deg, 73.5);
  const ResultTable table = verdict_table({test}, study);
  REQUIRE(table.rows.size() == 1);
  const std::vector<std::string>& row = table.rows[0];
  CHECK(row == std::vector<std::string>{"flexion", "572.33 flexion", "flexion-120", "FAIL",
                                        "3 of 6", "time of moment decay", "+3.60", "met"});

  const ResultTable figures = verdict_figure_table({test});
  CHECK(figures.rows.size() == 6 + 6);
  CHECK(figures.rows[0] == std::vector<std::string>{"flexion", "peak rotation", "71.0",
                                                    "64.0 to 78.0", "deg", "pass", "+0.00"});
  CHECK(figures.rows[3][5] == "FAIL");
  CHECK(figures.rows[6][1] == "impact velocity");
  CHECK(figures.rows[6][5] == "met");
  CHECK_THAT(figures.notes.front(), Contains("49 CFR 572.33"));

  // Without a run the table reports only that.
  const ResultTable none =
      verdict_table({{study.tests[0], JudgedTest::Status::not_run, {}, ""}}, study);
  CHECK(none.rows[0][3] == "not run");
  CHECK_THAT(none.notes.front(), Contains("flexneck pendulum"));
  // A value that cannot be determined counts as the largest deviation.
  const ResultTable lost = verdict_table({judged_test(study, 0, -1, 73.5)}, study);
  CHECK(lost.rows[0][5] == "peak rotation");
  CHECK(lost.rows[0][6] == "not found");
}

TEST_CASE("no run depends on the tests that judge it, nor on whose neck it is said to be") {
  const Study study = built_in();
  for (const TestSection& test : study.tests) {
    const Provenance made_from = case_provenance(study, case_named(study, test.experiment));
    CHECK(made_from.parameters.size() > 20);
    for (const Parameter& parameter : made_from.parameters) {
      INFO(parameter.key);
      CHECK_FALSE(parameter.key.starts_with("test."));
      CHECK_FALSE(parameter.key.starts_with("dummy."));
    }
  }
}

TEST_CASE("a test that cannot be is refused with what there is") {
  CHECK_THROWS_WITH(
      built_in({"test.flexion.regulation=572.33 flexoin"}),
      Contains("test.flexion.regulation: ") && Contains("did you mean '572.33 flexion'"));
  CHECK_THROWS_WITH(built_in({"test.flexion.case=flexoin-120"}),
                    Contains("test.flexion.case: ") && Contains("did you mean 'flexion-120'"));
  CHECK_THROWS_WITH(built_in({"test.flexion.case=extension-120"}),
                    Contains("test.flexion.case: expected a case of the pendulum in the direction "
                             "of '572.33 flexion', found 'extension-120'"));
  CHECK_THROWS_WITH(built_in({"test.flexion.case=flexion"}),
                    Contains("test.flexion.case: expected a case of the pendulum"));
  CHECK_THROWS_WITH(built_in({"test.flexion.limits=1"}), Contains("test.flexion.limits: unknown"));
  CHECK_THROWS_WITH(built_in({"dummy.nam=THOR"}), Contains("dummy.nam: unknown"));
}

TEST_CASE("a regulation may be a file of the user's own") {
  const TemporaryFolder folder;
  std::filesystem::copy_file(
      std::filesystem::path(FLEXNECK_SOURCE_DIR) / "pipeline/data/regulations/572.123.toml",
      folder / "mine.toml");
  const auto study = [&](const std::string& dummy) {
    std::ofstream(folder / "study.toml")
        << "include = [\"" << built_in_study().string() << "\"]\n"
        << dummy << "[[test]]\nname = \"child\"\nfile = \"mine.toml\"\n"
        << "regulation = \"572.123 flexion\"\ncase = \"flexion-60\"\n";
    return read_study(folder / "study.toml", {});
  };
  const Study read = study("[dummy]\nname = \"Hybrid III six-year-old\"\n");
  REQUIRE(read.tests.back().name == "child");
  CHECK(read.tests.back().file == folder / "mine.toml");
  CHECK(applies(read.tests.back(), read));
  CHECK_FALSE(applies(read.tests.front(), read));
  std::ofstream(folder / "mine.toml", std::ios::app) << "[other]\n";
  CHECK_THROWS_WITH(study(""), Contains("mine.toml:") && Contains("other: unknown key"));

  // A study that has none of the tests it includes.
  std::ofstream(folder / "none.toml")
      << "include = [\"" << built_in_study().string() << "\"]\ntest = []\n";
  CHECK(read_study(folder / "none.toml", {}).tests.empty());
}
