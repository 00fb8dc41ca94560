// SPDX-License-Identifier: GPL-3.0-or-later
// The shipped fits at reduced size: a coarse mesh, one start.
#include "pipeline/laboratory/rating/cora.h"
#include "pipeline/laboratory/rating/iso18571.h"
#include "pipeline/laboratory/rating/resampling.h"
#include "pipeline/language/study/study.h"
#include "pipeline/parameter_studies/evaluation/evaluator.h"
#include "tests/pipeline/parameter_studies/fit/fit_runs.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::testing;

namespace {

const std::string kFits = std::string(FLEXNECK_SOURCE_DIR) + "/pipeline/data/studies/fits/";

}  // namespace

TEST_CASE("from a neutral start the neck's dimensions come within 0.5 % of the six frequencies") {
  const TemporaryFolder folder;
  const CommandOutcome outcome =
      run_flexneck("fit " + kFits + "six_frequencies.toml -o " + (folder / "out").string() +
                   " --set mesh.quadrant=2 --set mesh.inner_ring=2 --set mesh.rubber_layers=1");
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.text, Contains("derivatives in closed form") && Contains("Not unique: "));
  const nlohmann::json targets = table_in(folder / "out", "fit targets");
  REQUIRE(targets.at("rows").size() == 8);
  // The results match the hand-made sets A (0.4 %) and B (0.3 %) to a tenth of a per cent for the
  // mesh.
  for (std::size_t row = 0; row < 6; ++row) CHECK(std::abs(cell(targets, row, 4)) < 0.5);
  CHECK(targets.at("rows").at(6).at(7) == "held out");
  CHECK(table_in(folder / "out", "fit choices").at("rows").size() == 4);
  // The fitted study states the targets of its fit until a dimension changes; not those held out.
  const std::filesystem::path fitted = folder / "out/fitted.toml";
  CHECK(pipeline::read_study(fitted, {}).neck()->fitted_to ==
        std::vector<std::string>{"bending 1", "bending 2", "torsion 1", "bending 3", "bending 4",
                                 "torsion 2"});
  CHECK(pipeline::read_study(fitted, {"variables.end_rubber_offset=0.3 in"})
            .neck()
            ->fitted_to.empty());
}

TEST_CASE("the head spring is found again from its curves") {
  const TemporaryFolder folder;
  const CommandOutcome outcome =
      run_flexneck("fit " + kFits + "head_spring.toml -o " + (folder / "out").string() +
                   " --set fit.starts=1 --set fit.profiles=false");
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
  const nlohmann::json parameters = table_in(folder / "out", "fit parameters");
  CHECK(cell(parameters, 0, 2) == Approx(20).margin(1));
  CHECK(cell(parameters, 1, 2) == Approx(6000).epsilon(0.02));
  CHECK(cell(parameters, 2, 2) == Approx(0.192).epsilon(0.02));
  const nlohmann::json targets = table_in(folder / "out", "fit targets");
  CHECK(std::abs(cell(targets, 2, 5)) < 0.1);  // the held-out target is predicted
}

TEST_CASE("the rating of the example's curve rises from the one to the other value of the README") {
  const TemporaryFolder folder;
  const std::string study =
      std::string(FLEXNECK_SOURCE_DIR) + "/pipeline/data/studies/examples/lab_rotation.toml";
  const std::vector<std::string> coarse = {"mesh.quadrant=2", "mesh.inner_ring=2",
                                           "mesh.rubber_layers=1"};
  std::string arguments = "fit " + study + " -o " + (folder / "out").string();
  for (const std::string& setting : coarse) arguments += " --set " + setting;
  require_done(arguments + " --set fit.starts=1");
  const nlohmann::json parameters = table_in(folder / "out", "fit parameters");
  CHECK(cell(parameters, 0, 2) == Approx(0.6).margin(0.02));
  CHECK(cell(parameters, 1, 2) == Approx(0.95).margin(0.03));

  pipeline::Evaluator evaluator({study, coarse}, quiet_console());
  const pipeline::WantedOutputs wanted =
      evaluator.wanted({}, {"pendulum.flexion-60.head rotation"});
  const pipeline::Curve& measured = evaluator.base().measured.at(0).curves.at(0).curve;
  // Ratings by ISO/TS 18571 and CORA.
  const auto ratings = [&](const std::vector<std::string>& settings) {
    const pipeline::Evaluation found = evaluator.evaluate(settings, wanted);
    const pipeline::Curve computed = pipeline::in_unit(
        {"", "head rotation", "rad", found.times_s.at(0), found.curves.at(0)}, measured.unit);
    const pipeline::ResampledPair pair = pipeline::resampled(measured, computed, {});
    const pipeline::SampleRange range = pipeline::cora_interval(pair.reference);
    const Eigen::Index count = range.last - range.first + 1;
    return std::pair(pipeline::rate_iso18571(pair.reference, pair.computed).overall,
                     pipeline::rate_cora(pair.reference.segment(range.first, count),
                                         pair.computed.segment(range.first, count))
                         .overall);
  };
  const auto [before, before_cora] = ratings({});
  CHECK(before == Approx(0.676).margin(0.03));  // the coarse mesh changes it by this much
  CHECK(before_cora == Approx(0.629).margin(0.04));
  const auto value = [&](std::size_t row) {
    return parameters.at("rows").at(row).at(2).get<std::string>();
  };
  const auto [after, after_cora] =
      ratings({"body.neck.damping_ratio=" + value(0),
               "geometry.materials.butyl.youngs_modulus=\"" + value(1) + " kpsi\""});
  CHECK(after == Approx(0.938).margin(0.01));
  CHECK(after_cora == Approx(0.999).margin(0.01));
}
