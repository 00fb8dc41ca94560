// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/foundation/temporary_folder.h"
#include "pipeline/experiments/pendulum_tables.h"
#include "pipeline/results/report/corridors.h"
#include "pipeline/results/report/paper_context.h"
#include "tests/pipeline/results/report_page.h"

using namespace flexneck;
using namespace flexneck::pipeline;
using Catch::Matchers::Contains;
using testing::built_in;
using testing::joined;

namespace {

std::vector<std::string> paper_remarks() {
  return read_paper_remarks(std::filesystem::path(FLEXNECK_SOURCE_DIR) /
                            "pipeline/data/verification/hybrid3_context.toml");
}

}  // namespace

TEST_CASE("what the report says of pulses follows from their origins and from the corridors") {
  const Study& study = built_in();
  CHECK(joined(pulse_remarks(study)) ==
        "The pulse 'flexion' is synthetic according to the study and, without scaling, inside the "
        "corridor of 572.33 flexion. The table of velocities shows how the cases scale it.\nThe "
        "pulse 'extension' is synthetic according to the study and, without scaling, inside the "
        "corridor of 572.33 extension. The table of velocities shows how the cases scale it.\n");
  CHECK_THAT(joined(peak_table(study, {}).notes),
             Contains("according to the study: 'flexion' synthetic, 'extension' synthetic."));

  const TemporaryFolder folder;
  std::ofstream(folder / "mine.csv") << "time [ms], deceleration [gn]\n0, 0\n10, 20\n50, 0\n";
  std::ofstream(folder / "mine.toml")
      << "include = [\"" << built_in_study().string() << "\"]\n"
      << "[[pulse]]\nname = \"flexion\"\n"
         "table = { value = \"mine.csv\", origin = \"published\", note = \"a source\" }\n"
         "times = []\ndeceleration = []\n"
         "[[pulse]]\nname = \"extension\"\ntable = \"mine.csv\"\n"
         "times = []\ndeceleration = []\n";
  const Study own = read_study(folder / "mine.toml", {});
  const std::string remarks = joined(pulse_remarks(own));
  CHECK_THAT(
      remarks,
      Contains("'flexion' is published according to the study and, without scaling, outside") &&
          !Contains("inside"));
  CHECK_THAT(joined(peak_table(own, {}).notes), Contains("'flexion' published"));
  CHECK_THAT(joined(paper_remarks()), !Contains("synthetic") && !Contains("inside"));
}

TEST_CASE("a pulse is inside of a corridor if it keeps to all of it") {
  CertificationTest test;
  test.pulse = DecelerationPulse{{0.01, 0.02}, {{20, 30}, {10, 20}}, 15, 5, {0.03, 0.04}};
  const auto is_in = [&](std::vector<double> times_s, std::vector<double> values) {
    return is_inside(PulseSection{"", std::move(times_s), std::move(values)}, test);
  };
  CHECK(is_in({0, 0.01, 0.02, 0.03, 0.04}, {0, 25, 15, 10, 0}));
  CHECK_FALSE(is_in({0, 0.01, 0.02, 0.03, 0.04}, {0, 31, 15, 10, 0}));
  CHECK_FALSE(is_in({0, 0.01, 0.02, 0.03, 0.04}, {0, 25, 9, 10, 0}));
  CHECK_FALSE(is_in({0, 0.01, 0.02, 0.03, 0.04}, {0, 25, 15, 16, 0}));  // too high after
  CHECK_FALSE(is_in({0, 0.01, 0.02, 0.025}, {0, 25, 15, 0}));           // falls too early
  CHECK_FALSE(is_in({0, 0.01, 0.02, 0.05}, {0, 25, 15, 6}));            // too late
  CHECK_FALSE(is_in({0, 0.005}, {25, 25}));
}

TEST_CASE("corridors stand behind the curves of the cases that are judged by them") {
  const auto corridors_at = [](const std::string& experiment, const std::string& channel,
                               const std::vector<std::string>& settings = {}) {
    std::vector<Corridor> found = corridors_of(read_study(built_in_study(), settings));
    std::erase_if(found, [&](const Corridor& corridor) {
      return corridor.experiment != experiment || corridor.channel != channel;
    });
    return found;
  };
  const double degree = std::numbers::pi / 180;
  const auto flexion = corridors_at("flexion-120", "head rotation");
  REQUIRE(flexion.size() == 2);
  CHECK(flexion[0].what == "572.33 flexion, peak rotation");
  CHECK(flexion[0].times_s.low == Approx(0.057));
  CHECK(flexion[0].times_s.high == Approx(0.064));
  CHECK(flexion[0].values.low == Approx(64 * degree));
  CHECK(flexion[0].values.high == Approx(78 * degree));
  CHECK(flexion[1].times_s.low == Approx(0.113));
  CHECK(flexion[1].values.high == 0);
  // The channel is negative in extension.
  const auto extension = corridors_at("extension-120-part572", "head rotation");
  REQUIRE(extension.size() == 2);
  CHECK(extension[0].values.low == Approx(-106 * degree));
  CHECK(extension[0].values.high == Approx(-81 * degree));
  const auto moment = corridors_at("extension-120-part572", "load cell moment");
  REQUIRE(moment.size() == 2);
  CHECK(moment[0].values.low == Approx(-59 * 1.3558179483));  // lbf ft
  // There are no corridors at another velocity or for another dummy.
  CHECK(corridors_at("flexion-120", "head rotation", {"case.flexion-120.impact_velocity=200 in/s"})
            .empty());
  CHECK(corridors_at("flexion-120", "head rotation", {"dummy.name=Hybrid III 5th female"}).empty());
}
