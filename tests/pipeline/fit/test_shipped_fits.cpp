// SPDX-License-Identifier: GPL-3.0-or-later
// The shipped fits at reduced size: a coarse mesh, one start.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/foundation/temporary_folder.h"
#include "pipeline/evaluation/evaluator.h"
#include "pipeline/rating/cora.h"
#include "pipeline/rating/iso18571.h"
#include "pipeline/rating/resampling.h"
#include "pipeline/study/study.h"
#include "tests/support/files.h"
#include "tests/support/flexneck_command.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::testing;

namespace {

const std::string kFits = std::string(FLEXNECK_SOURCE_DIR) + "/pipeline/studies/fits/";

nlohmann::json rows_of(const std::filesystem::path& out, const std::string& name) {
  const nlohmann::json file = nlohmann::json::parse(bytes_of(out / "fit.json"));
  for (const nlohmann::json& table : file.at("tables"))
    if (table.at("name") == name) return table.at("rows");
  FAIL("no table " + name);
  return {};
}

double cell(const nlohmann::json& rows, std::size_t row, std::size_t column) {
  return std::stod(rows.at(row).at(column).get<std::string>());
}

}  // namespace

TEST_CASE("from a neutral start the neck's dimensions come within 0.5 % of the six frequencies") {
  const TemporaryFolder folder;
  const CommandOutcome outcome =
      run_flexneck("fit " + kFits + "six_frequencies.toml -o " + (folder / "out").string() +
                   " --set mesh.quadrant=2 --set mesh.inner_ring=2 --set mesh.rubber_layers=1");
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.text, Contains("slopes in closed form") && Contains("Not unique: "));
  const nlohmann::json targets = rows_of(folder / "out", "fit targets");
  REQUIRE(targets.size() == 8);
  // As the hand-made sets A (0.4 %) and B (0.3 %) to a tenth of a per cent for the mesh.
  for (std::size_t row = 0; row < 6; ++row) CHECK(std::abs(cell(targets, row, 4)) < 0.5);
  CHECK(targets.at(6).at(7) == "held out");
  CHECK(rows_of(folder / "out", "fit choices").size() == 4);
  // The fitted study states what it was fitted to, until a dimension changes; not what was held
  // out.
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
  const nlohmann::json rows = rows_of(folder / "out", "fit parameters");
  CHECK(cell(rows, 0, 2) == Approx(20).margin(1));
  CHECK(cell(rows, 1, 2) == Approx(6000).epsilon(0.02));
  CHECK(cell(rows, 2, 2) == Approx(0.192).epsilon(0.02));
  const nlohmann::json targets = rows_of(folder / "out", "fit targets");
  CHECK(std::abs(cell(targets, 2, 5)) < 0.1);  // what was held out is predicted
}

TEST_CASE("the rating of the example's curve rises from the one to the other value of the README") {
  const TemporaryFolder folder;
  const std::string study =
      std::string(FLEXNECK_SOURCE_DIR) + "/pipeline/studies/examples/lab_rotation.toml";
  const std::vector<std::string> coarse = {"mesh.quadrant=2", "mesh.inner_ring=2",
                                           "mesh.rubber_layers=1"};
  // By ISO/TS 18571 and CORA.
  const auto ratings = [&](const std::filesystem::path& file) {
    const pipeline::Console console(pipeline::Verbosity::quiet);
    pipeline::Evaluator evaluator({file, coarse}, console);
    const pipeline::WantedOutputs wanted =
        evaluator.wanted({}, {"pendulum.flexion-60.head rotation"});
    const pipeline::Evaluation found = evaluator.evaluate({}, wanted);
    const pipeline::Curve& measured = evaluator.base().measured.at(0).curves.at(0).curve;
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
  std::string arguments = "fit " + study + " -o " + (folder / "out").string();
  for (const std::string& setting : coarse) arguments += " --set " + setting;
  const CommandOutcome outcome = run_flexneck(arguments + " --set fit.starts=1");
  INFO(outcome.text);
  REQUIRE(outcome.exit_code == 0);
  const auto [before, before_cora] = ratings(study);
  CHECK(before == Approx(0.676).margin(0.01));
  CHECK(before_cora == Approx(0.629).margin(0.02));
  const auto [after, after_cora] = ratings(folder / "out/fitted.toml");
  CHECK(after == Approx(0.938).margin(0.01));
  CHECK(after_cora == Approx(0.999).margin(0.01));
  const nlohmann::json rows = rows_of(folder / "out", "fit parameters");
  CHECK(cell(rows, 0, 2) == Approx(0.6).margin(0.02));
  CHECK(cell(rows, 1, 2) == Approx(0.95).margin(0.03));
}
