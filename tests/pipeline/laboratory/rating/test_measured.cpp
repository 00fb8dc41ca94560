// SPDX-License-Identifier: GPL-3.0-or-later
// Tests in a study with measured curves, corridors and limits.
#include <cmath>
#include <fstream>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/foundation/temporary_folder.h"
#include "multibody/signals/cfc_filter.h"
#include "pipeline/laboratory/iso_mme/test_writer.h"
#include "pipeline/language/study/study.h"
#include "pipeline/results/tables/measured_tables.h"

namespace flexneck::pipeline {
namespace {

using Catch::Matchers::Contains;
using Eigen::VectorXd;

constexpr double kDeg = std::numbers::pi / 180;

/// A history with a head rotation of 60 deg at 50 ms that is back at zero at 100 ms, from 0 to 200
/// ms.
multibody::HistoryFile half_waves() {
  multibody::HistoryFile run;
  run.history.time_s = VectorXd::LinSpaced(401, 0, 0.2);
  const VectorXd angle = 60 * kDeg * (run.history.time_s.array() * std::numbers::pi / 0.1).sin();
  run.channels = {{"head rotation", "rad", {"head rotation"}, angle.transpose(), ""}};
  return run;
}

class OwnTest {
 public:
  /// Writes a line every half millisecond: head rotation of half_waves() times a factor, shifted.
  void write_curve(const std::string& name, double factor, double zero_ms,
                   const std::string& head = "time [ms],phi [deg]\n") const {
    std::ofstream file(folder_ / name);
    file << head;
    for (int k = 0; k <= 400; ++k)
      file << 0.5 * k + zero_ms << "," << factor * 60 * std::sin(0.5 * k * std::numbers::pi / 100)
           << "\n";
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  /// Writes that curve as the only channel of an ISO-MME test, from -10 ms to 200 ms.
  void write_channel(const std::string& name, char filter) const {
    MmeTest test;
    VectorXd values(421);
    for (int k = 0; k <= 420; ++k)
      values[k] = 60 * std::sin((0.5 * k - 10) * std::numbers::pi / 100);
    test.channels = {{"11HEAD0000H3ANY" + std::string(1, filter), "", "deg", -0.01, 5e-4, values}};
    write_mme_test(folder_ / name / (name + ".mme"), test);
  }
  MeasuredRun read(const std::string& tables) const {
    std::ofstream(folder_ / "study.toml") << "include = [\"" << built_in_study().string() << "\"]\n"
                                          << "[[test]]\nname = \"lab\"\ncase = \"flexion-60\"\n"
                                          << tables;
    const Study study = read_study(folder_ / "study.toml", {});
    REQUIRE(study.measured.size() == 1);
    CHECK(study.tests.size() == 4);  // the study has those of regulations
    return {study.measured.front(), half_waves()};
  }
  void refuses(const std::string& tables, const std::string& reason) const {
    INFO(tables);
    CHECK_THROWS_WITH(read(tables), Contains(reason));
  }

 private:
  TemporaryFolder folder_;
};

const std::string kCurve = "[[test.curve]]\nchannel = \"head rotation\"\ntable = \"lab.csv\"\n";

}  // namespace

TEST_CASE("a measured curve is laid over the case's time and rated") {
  const OwnTest own;
  own.write_curve("lab.csv", 1, 12.5);
  const MeasuredRun same = own.read(kCurve + "time_zero = \"12.5 ms\"\n");
  const ResultTable table = measured_curve_table({same});
  REQUIRE(table.rows.size() == 1);
  CHECK(table.rows[0] == std::vector<std::string>{"lab", "flexion-60", "head rotation",
                                                  "lab.csv: phi", "0.0", "200.0", "1.000",
                                                  "1.000"});
  // Without time_zero the curve is late by an eighth of the wave: C is rated lower.
  const ResultTable late = measured_curve_table({own.read(kCurve)});
  CHECK(late.rows[0][4] == "12.5");
  CHECK(std::stod(late.rows[0][6]) < 0.8);
  const ResultTable cut = measured_curve_table(
      {own.read(kCurve + "time_zero = \"12.5 ms\"\nfrom = \"20 ms\"\nto = \"90 ms\"\n")});
  CHECK(cut.rows[0][4] == "20.0");
  CHECK(cut.rows[0][5] == "90.0");
  // A test without a run is listed, but not rated.
  const ResultTable none = measured_curve_table({{same.test, {}}});
  CHECK(none.rows.empty());
  CHECK_THAT(none.notes.front(), Contains("There is no run of flexion-60 yet"));
}

TEST_CASE(
    "a measured curve is filtered by its class, and files without names have the unit given") {
  const OwnTest own;
  // Two columns without names are seconds and values.
  own.write("plain.csv", "0,1\n0.1,2\n0.2,3\n");
  const std::string plain = "[[test.curve]]\nchannel = \"head rotation\"\ntable = \"plain.csv\"\n";
  const Curve curve = own.read(plain + "unit = \"deg\"\n").test.curves.front().curve;
  CHECK(curve.unit == "deg");
  CHECK(curve.time_s[2] == 0.2);
  own.refuses(plain, "test.lab.curve.1.unit: expected this key");
  VectorXd raw(401);
  for (Eigen::Index k = 0; k < 401; ++k)
    raw[k] = 60 * std::sin(0.5 * static_cast<double>(k) * std::numbers::pi / 100);
  const VectorXd filtered = multibody::cfc_filtered(raw, 5e-4, multibody::ChannelClass::cfc60);
  own.write_curve("lab.csv", 1, 0);
  CHECK((own.read(kCurve + "filter = \"CFC 60\"\n").test.curves.front().curve.values - filtered)
            .cwiseAbs()
            .maxCoeff() < 1e-4);
}

TEST_CASE("a corridor tells how much of the time a curve is inside, and where it is furthest out") {
  const OwnTest own;
  const auto row = [&](const std::string& tables) {
    return measured_limit_table({own.read(tables)}).rows.at(0);
  };
  const std::string corridor = "[[test.corridor]]\nchannel = \"head rotation\"\n";
  // The sine is above 30 deg from 16.7 to 83.3 ms: at the samples from 17.0 to 83.0 of 0 to 100.
  const auto above = row(corridor +
                         "times = [\"0 ms\", \"100 ms\"]\nlower = [30, 30]\nupper = [70, 70]\n"
                         "unit = \"deg\"\n");
  CHECK(above[4] == "66.2 % inside");  // 133 of 201
  CHECK(above[5] == "off by -30 at 0.0 ms");
  CHECK(above[7] == "FAIL");
  own.write("c.csv", "time [s],upper [rad],lower [deg]\n0,1.2,-61\n0.2,1.2,-61\n");
  const auto wide = row(corridor + "table = \"c.csv\"\n");
  CHECK(wide[4] == "100.0 % inside");
  CHECK(wide[7] == "pass");
}

TEST_CASE("limits of peaks, their times and zero crossings are judged in any unit") {
  const OwnTest own;
  const auto verdict = [&](const std::string& figure, const std::string& limits) {
    const auto rows = measured_limit_table({own.read("[[test.limit]]\nchannel = \"head rotation\"\n"
                                                     "figure = \"" +
                                                     figure + "\"\n" + limits)})
                          .rows;
    return rows.at(0)[4] + " " + rows.at(0)[5] + " " + rows.at(0)[6] + ": " + rows.at(0)[7];
  };
  CHECK(verdict("peak", "low = \"1 rad\"\nhigh = \"61 deg\"\n") == "60 57.3 to 61 deg: pass");
  CHECK(verdict("peak", "high = \"59 deg\"\n") == "60 at most 59 deg: FAIL");
  CHECK(verdict("time of peak", "low = \"51 ms\"\n") == "50 at least 51 ms: FAIL");
  CHECK(verdict("first zero crossing", "low = \"0.099 s\"\nhigh = \"101 ms\"\n") ==
        "100 99 to 101 ms: pass");
  CHECK_THROWS_WITH(verdict("peak", "low = \"1 kg\"\n"),
                    Contains("test.lab.limit.1.low: ") && Contains("found 'kg'"));
  CHECK_THROWS_WITH(verdict("peak", "low = \"62 deg\"\nhigh = \"61 deg\"\n"),
                    Contains("expected a value above low"));
}

TEST_CASE("a channel of a test of ISO-MME stands for a CSV file, filtered as its code says") {
  const OwnTest own;
  own.write_curve("lab.csv", 1, 0);
  const std::string asked = "filter = \"CFC 180\"\n";
  const auto read = [&](char filter, const std::string& keys) {
    const std::string name = std::string("lab") + filter;
    own.write_channel(name, filter);
    return own.read("[[test.curve]]\nchannel = \"head rotation\"\ntable = \"" + name + "\"\n" +
                    keys);
  };
  const MeasuredRun plain = read('0', "");
  const ResultTable table = measured_curve_table({plain});
  CHECK(table.rows.at(0) == std::vector<std::string>{"lab", "flexion-60", "head rotation",
                                                     "lab0: 11HEAD0000H3ANY0", "0.0", "200.0",
                                                     "1.000", "1.000"});
  CHECK(table.notes.size() == measured_curve_table({own.read(kCurve)}).notes.size());
  const VectorXd open = plain.test.curves.at(0).curve.values;
  CHECK(read('C', asked).test.curves.at(0).curve.values == open);
  for (const char wider : {'0', 'P', 'B'}) {
    const VectorXd filtered = multibody::cfc_filtered(open, 5e-4, multibody::ChannelClass::cfc180);
    CHECK(read(wider, asked).test.curves.at(0).curve.values == filtered);
  }
  CHECK_THROWS_WITH(read('D', asked), Contains("test.lab.curve.1.filter: ") &&
                                          Contains("is already filtered with \"CFC 60\""));
  CHECK_THAT(measured_curve_table({read('D', "")}).notes.at(0),
             Contains("'head rotation' is filtered with CFC 60 in the measurement and with no "
                      "filter in the computation"));
  own.refuses("[[test.curve]]\nchannel = \"head rotation\"\ntable = \"labD\"\nunit = \"deg\"\n",
              "already gives the unit 'deg'");
  own.refuses("[[test.curve]]\nchannel = \"head rotation\"\ntable = \"labD\"\ncolumn = \"x\"\n",
              "there is no channel 'x'");
}

TEST_CASE("measured data that cannot be is refused with what there is") {
  const OwnTest own;
  own.write_curve("lab.csv", 1, 0);
  own.refuses("", "expected this key, or [[test.curve]]");
  own.refuses(kCurve + "unit = \"deg\"\n", "the file already gives the unit 'deg'");
  own.refuses("[[test.curve]]\nchannel = \"head rotation\"\ntable = \"no.csv\"\n", "no.csv");
  own.write("slow.csv", "time [s],a [deg]\n0,1\n0.1,2\n0.2,3\n");
  own.write("uneven.csv", "time [s],a [deg]\n0,1\n0.001,2\n0.003,3\n");
  own.write("back.csv", "time [s],a [deg]\n0,1\n0.1,2\n0.1,3\n");
  const auto curve = [](const std::string& file) {
    return "[[test.curve]]\nchannel = \"head rotation\"\ntable = \"" + file + "\"\n";
  };
  own.refuses(curve("slow.csv") + "filter = \"CFC 60\"\n", "test.lab.curve.1.filter: ");
  own.refuses(curve("uneven.csv") + "filter = \"CFC 60\"\n", "equal intervals");
  own.refuses(curve("back.csv"), "times must increase strictly");
  const std::string corridor =
      "[[test.corridor]]\nchannel = \"head rotation\"\ntimes = [\"0 s\", \"1 s\"]\n";
  own.refuses(corridor + "unit = \"deg\"\nlower = [0, 5]\nupper = [1, 4]\n",
              "the corridor crosses itself: upper is below lower at 1 s");
  own.refuses(corridor + "lower = [0, 5]\nupper = [1, 9]\n", "expected the unit");
  own.refuses(corridor + "unit = \"deg\"\nlower = [0]\nupper = [1, 9]\n", "list of 2 entries");
  const auto told = [&](const std::string& tables) {
    const MeasuredRun run = own.read(tables);
    measured_curve_table({run});
    measured_limit_table({run});
  };
  CHECK_THROWS_WITH(told("[[test.curve]]\nchannel = \"head rotatoin\"\ntable = \"lab.csv\"\n"),
                    Contains("test.lab, case flexion-60: ") && Contains("did you mean"));
  own.write("force.csv", "time [s],F [N]\n0,1\n0.1,2\n");
  CHECK_THROWS_WITH(told(curve("force.csv")), Contains("'F' [N]"));
  CHECK_THROWS_WITH(told(curve("lab.csv") + "to = \"300 ms\"\n"), Contains("lab.csv"));
  CHECK_THROWS_WITH(told(corridor + "unit = \"deg\"\nlower = [0, 0]\nupper = [9, 9]\n"),
                    Contains("the run ends at 0.2 s"));
}

}  // namespace flexneck::pipeline
