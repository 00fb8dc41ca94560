// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <sstream>

#include <catch2/catch.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "geometry/foundation/temporary_folder.h"
#include "multibody/signals/cfc_filter.h"
#include "pipeline/laboratory/iso_mme/test_writer.h"
#include "pipeline/laboratory/rating/iso18571.h"
#include "tests/pipeline/laboratory/rating/rated_signals.h"
#include "tests/support/files.h"
#include "tests/support/flexneck_command.h"
#include "tests/support/model_text.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::testing;
using Eigen::VectorXd;

namespace {

namespace fs = std::filesystem;

constexpr double kInterval_s = 1e-4;

/// CSV text of columns over the time from zero on.
std::string table(const std::string& head, const std::vector<VectorXd>& columns,
                  double interval = kInterval_s) {
  std::string text = head.empty() ? "" : head + "\n";
  for (Eigen::Index k = 0; k < columns.front().size(); ++k) {
    text += fmt::format("{}", interval * static_cast<double>(k));
    for (const VectorXd& column : columns) text += fmt::format(",{}", column[k]);
    text += "\n";
  }
  return text;
}

/// A folder with a reference and a computed curve.
class RatedFolder {
 public:
  RatedFolder() {
    write("reference.csv", table("time [s],head angle [rad]", {reference()}));
    write("computed.csv", table("time [s],head angle [rad]", {computed()}));
  }
  static VectorXd reference() { return pulse(500, 60, 400); }
  static VectorXd computed() { return 1.1 * pulse(500, 75, 410); }

  void write(const std::string& name, const std::string& text) const {
    testing::write_test_file(folder_ / name, text);
  }
  /// Runs the command in the folder, so that files keep their plain names.
  CommandOutcome run(const std::string& arguments) const {
    return run_shell("(cd " + folder_.path().string() + "; " + flexneck_program() + " " +
                     arguments + ")");
  }
  /// Checks that another computed curve is refused.
  void refuses(const std::string& text, const std::string& reason,
               const std::string& options = "") const {
    write("bad.csv", text);
    check_refused(run("rate reference.csv bad.csv " + options), reason);
  }
  fs::path path(const std::string& name) const { return folder_ / name; }

 private:
  TemporaryFolder folder_;
};

std::string cell(const nlohmann::json& table, std::size_t row) {
  return table.at("rows").at(row).at(1).get<std::string>();
}

}  // namespace

TEST_CASE("'flexneck rate' prints each part of both ratings, and writes only where it is told to") {
  const RatedFolder folder;
  const CommandOutcome printed = folder.run("rate reference.csv computed.csv");
  INFO(printed.text);
  CHECK(printed.exit_code == 0);
  for (const char* const part :
       {"ISO/TS 18571:2024, 0 to 0.0499 s", "corridor Z", "phase P", "magnitude M", "slope S",
        "overall R", "CORA 4.0.5", "progression V", "size G", "overall C", "500 samples at 10 kHz",
        "late by 1.2 ms"})
    CHECK_THAT(printed.text, Contains(part));
  std::istringstream lines(printed.text);
  for (std::string line; std::getline(lines, line);) CHECK(line.size() <= 100);
  CHECK(names_in(folder.path(".")) == std::vector<std::string>{"computed.csv", "reference.csv"});

  const CommandOutcome quiet = folder.run("rate -q reference.csv computed.csv -o out");
  CHECK(quiet.exit_code == 0);
  CHECK(quiet.text.empty());
  CHECK(names_in(folder.path("out")) == std::vector<std::string>{"rating.json"});
  const auto json = nlohmann::json::parse(bytes_of(folder.path("out/rating.json")));
  const pipeline::Iso18571Rating rating =
      pipeline::rate_iso18571(RatedFolder::reference(), RatedFolder::computed());
  const auto& iso = json.at("tables").at(0);
  CHECK(cell(iso, 0) == fmt::format("{:.6f}", rating.corridor));
  CHECK(cell(iso, 4) == fmt::format("{:.6f}", rating.overall));
  CHECK(json.at("provenance").at("inputs").size() == 2);
  CHECK(json.at("provenance").at("inputs").contains("computed/computed.csv"));
  CHECK_THAT(folder.run("info out/rating.json").text, Contains("overall R"));

  // Two files have the same name in two folders.
  fs::create_directory(folder.path("other"));
  folder.write("other/computed.csv", bytes_of(folder.path("computed.csv")));
  CHECK_THAT(folder.run("rate computed.csv other/computed.csv").text,
             Contains("computed   other/computed.csv: 'head angle' [rad]"));
}

TEST_CASE("'flexneck rate' takes columns by name, other units and plain files") {
  const RatedFolder folder;
  const std::string expected = folder.run("rate reference.csv computed.csv -o a").text;
  const auto rows = [&](const char* out) {
    const auto json =
        nlohmann::json::parse(bytes_of(folder.path(std::string(out) + "/rating.json")));
    std::string text;
    for (const auto& each : json.at("tables")) text += each.at("rows").dump();
    return text;
  };
  // The curve is in degrees over milliseconds, beside other columns, one of which has a comma in
  // its name.
  const double degrees = 45 / std::atan(1);
  folder.write("many.csv", table("time [ms],\"Fx, upper [N]\",phi [deg]",
                                 {RatedFolder::reference(), degrees * RatedFolder::computed()},
                                 1e3 * kInterval_s));
  CHECK(
      folder.run("rate reference.csv many.csv --channel phi --reference-channel 'head angle' -o b")
          .exit_code == 0);
  CHECK(rows("b") == rows("a"));
  folder.write("plain.csv", table("", {RatedFolder::computed()}));
  CHECK(folder.run("rate reference.csv plain.csv --unit rad -o c").exit_code == 0);
  CHECK(rows("c") == rows("a"));
  folder.write("plain reference.csv", table("# measured", {RatedFolder::reference()}));
  CHECK(folder.run("rate 'plain reference.csv' plain.csv -o d").exit_code == 0);
  CHECK(rows("d") == rows("a"));
  CHECK_THAT(folder.run("rate many.csv many.csv --channel 'Fx, upper'").text,
             Contains("overall R    1.000000"));

  check_refused(folder.run("rate reference.csv plain.csv"), "set it with --unit");
  check_refused(folder.run("rate reference.csv computed.csv --unit rad"), "--unit: both files");
  check_refused(folder.run("rate reference.csv plain.csv --unit N"), "has another dimension");
  check_refused(folder.run("rate reference.csv plain.csv --channel 'head angle'"), "plain.csv:1:");
  check_refused(folder.run("rate reference.csv many.csv"), "choose one of 'Fx, upper', 'phi'");
  check_refused(folder.run("rate many.csv many.csv --channel phy"), "did you mean 'phi'?");
}

TEST_CASE("'flexneck rate' rates the interval that it is told, or what both curves cover") {
  const RatedFolder folder;
  const CommandOutcome part =
      folder.run("rate reference.csv computed.csv --from '5 ms' --to 0.03s");
  CHECK_THAT(part.text, Contains("ISO/TS 18571:2024, 0.005 to 0.03 s") &&
                            Contains("CORA 4.0.5, 0.005 to 0.03 s\n") && Contains("251 samples"));
  folder.write("longer.csv", table("time [s],head angle [rad]", {pulse(800, 75, 410)}));
  CHECK_THAT(folder.run("rate reference.csv longer.csv").text, Contains("0 to 0.0499 s"));
  check_refused(folder.run("rate reference.csv longer.csv --to '60 ms'"),
                "reference.csv: 'head angle' [rad]: covers 0 to 0.0499 s, but 0 to 0.06 s");
  check_refused(folder.run("rate reference.csv computed.csv --from '-1 ms'"), "covers 0 to");
  check_refused(folder.run("rate reference.csv computed.csv --from 5"), "--from: expected a unit");
  check_refused(folder.run("rate reference.csv computed.csv --to '5 m'"), "--to: expected a unit");
  check_refused(folder.run("rate reference.csv computed.csv --to '5 ms'"), "expected 100 to");
  check_refused(folder.run("rate reference.csv computed.csv --from '3 ms' --to '2 ms'"),
                "nothing is left");
}

TEST_CASE("'flexneck rate' resamples to 10 kHz, and says so") {
  const RatedFolder folder;
  // A ramp is the same for any sampling: a thousand samples per second suffice.
  const auto ramp = [](Eigen::Index count) {
    return table("time [s],F [N]", {VectorXd::LinSpaced(count, 0, 1)},
                 0.1 / static_cast<double>(count - 1));
  };
  folder.write("coarse.csv", ramp(101));
  folder.write("fine.csv", ramp(4001));
  const CommandOutcome outcome = folder.run("rate fine.csv coarse.csv");
  CHECK_THAT(outcome.text, Contains("1001 samples at 10 kHz, interpolated linearly") &&
                               Contains("overall R    1.000000"));
  folder.write("coarser.csv", ramp(99));
  check_refused(folder.run("rate fine.csv coarser.csv"),
                "coarser.csv: 'F' [N]: expected samples at most 0.001 s apart");
}

TEST_CASE("'flexneck rate' refuses bad input in one line that says where") {
  const RatedFolder folder;
  const std::string head = "time [s],head angle [rad]\n";
  const std::string good = bytes_of(folder.path("computed.csv"));
  folder.refuses("", "bad.csv:0: expected a header line with the names");
  folder.refuses("# nothing\n\n", "expected a header line with the names");
  folder.refuses(head, "expected at least two rows");
  folder.refuses(head + "0,1\n", "expected at least two rows");
  folder.refuses(head + "0,1\n0.1,nan\n", "bad.csv:3: expected a finite number, found \"nan\"");
  folder.refuses(head + "0,1\n0.1,-inf\n", "expected a finite number");
  folder.refuses(head + "0,1\n0.1,1e999\n", "expected a finite number");
  folder.refuses(head + "0,1\n0.1,\n", "expected a finite number, found \"\"");
  folder.refuses(head + "0,1\n0.1,2\n0.1,3\n", "bad.csv:4: times must increase strictly");
  folder.refuses(head + "0,1\n0.1,2\n-0.1,3\n", "bad.csv:4: times must increase strictly");
  folder.refuses(head + "0,1\n0.1,2,3\n", "expected 2 cells");
  folder.refuses("time [s];head angle [rad]\n0;1\n", "expected the time and at least one column");
  folder.refuses("time [s],\"head angle [rad]\n0,1\n", "a quote");
  folder.refuses("time [s],head angle [rad]\n0,\"\"22\n",
                 "expected a comma after the closing quote");
  folder.refuses("time,head angle [rad]\n0,1\n",
                 "expected the time with its unit in the first column");
  folder.refuses("time [kg],head angle [rad]\n0,1\n1,2\n", "bad.csv:1: column \"time [kg]\"");
  folder.refuses("time [s],a [rad],a [rad]\n0,1,1\n", "several columns 'a'",
                 "--channel a --reference-channel 'head angle'");
  folder.refuses("0,1,2\n1,2,3\n", "there are several columns");
  folder.refuses("time [s],angle\n" + good.substr(head.size()), "gives no unit of its values");
  folder.refuses("time [s],angle [N]\n" + good.substr(head.size()),
                 "bad.csv: 'angle' [N]: expected a unit such as 'rad', found 'N'");
  folder.refuses("time [s],angle [rad/s]\n" + good.substr(head.size()), "another dimension");
  folder.refuses("time [s],angle [blah]\n" + good.substr(head.size()), "unknown unit 'blah'");
  folder.refuses("time [ms],angle [rad]\n" + good.substr(head.size()),
                 "0 to 4.99e-05 s are 1 samp");
  folder.refuses(table("time [s],angle [rad]", {VectorXd::Zero(500)}),
                 "bad.csv: 'angle' [rad], against reference.csv: 'head angle' [rad]: the computed");
  folder.refuses(table("time [s],angle [rad]", {VectorXd::Constant(500, 0.1)}), "is constant");
  folder.refuses(std::string("time [s],a [rad]\n0,1\n\0\x01,2\n", 26), "bad.csv:");
  folder.refuses("time [s],a [rad]\r0,1\r1,2\r", "lines that end in LF or CRLF");
  folder.write("zero.csv", table("time [s],angle [rad]", {VectorXd::Zero(500)}));
  check_refused(folder.run("rate zero.csv computed.csv"), "the reference curve is constant");
  const std::string shifted = "time [s],angle [rad]\n10,0\n10.001,1\n10.002,3\n";
  folder.refuses(shifted, "nothing is left to rate");
  check_refused(folder.run("rate reference.csv"), "expected two files");
  check_refused(folder.run("rate reference.csv computed.csv zero.csv"), "found 3");
  check_refused(folder.run("rate reference.csv missing.csv"), "missing.csv");
  check_refused(folder.run("rate reference.csv ."), ".: ");
  check_refused(folder.run("rate reference.csv computed.csv --set a=1"), "--set is an option of");
  check_refused(folder.run("info reference.csv --channel a"),
                "--channel is an option of the command rate");
  check_refused(folder.run("rate reference.csv computed.csv -o ''"), "expected a folder");
  // A refused command leaves no files.
  check_refused(folder.run("rate zero.csv computed.csv -o none"), "constant");
  CHECK_FALSE(fs::exists(folder.path("none")));
}

TEST_CASE("'flexneck rate' takes values of any size") {
  const RatedFolder folder;
  for (const double size : {1e-300, 1e300}) {
    folder.write("a.csv", table("time [s],angle [rad]", {size * RatedFolder::reference()}));
    folder.write("b.csv", table("time [s],angle [rad]", {size * RatedFolder::computed()}));
    const CommandOutcome scaled = folder.run("rate a.csv b.csv --channel angle");
    const CommandOutcome plain = folder.run("rate reference.csv computed.csv");
    const auto overall = [](const std::string& text) {
      return text.substr(text.find("overall R"), 21);
    };
    CHECK(overall(scaled.text) == overall(plain.text));
  }
}

TEST_CASE("'flexneck rate' takes channels of ISO-MME, says what they have passed, and warns") {
  const RatedFolder folder;
  const auto write = [&](const char* name, const std::string& code, const VectorXd& values) {
    pipeline::MmeTest test;
    test.channels = {{code, "", "deg", 0, kInterval_s, 45 / std::atan(1) * values}};
    pipeline::write_mme_test(folder.path(name) / (std::string(name) + ".mme"), test);
  };
  write("lab", "11HEAD0000H3ANYC", RatedFolder::reference());
  write("run", "11HEAD0000H3ANY0", RatedFolder::computed());
  CHECK(folder.run("rate -q reference.csv computed.csv -o a").exit_code == 0);
  const CommandOutcome outcome = folder.run(
      "rate lab computed.csv --reference-channel 11HEAD0000H3ANYC --channel 'head angle' "
      "-o b");
  INFO(outcome.text);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.text,
             Contains("reference  lab: '11HEAD0000H3ANYC' [deg], CFC 180 by its channel code") &&
                 !Contains("Warning"));
  const auto overall = [&](const char* out) {
    return cell(nlohmann::json::parse(bytes_of(folder.path(out))).at("tables").at(0), 4);
  };
  CHECK(overall("b/rating.json") == overall("a/rating.json"));
  CHECK_THAT(bytes_of(folder.path("b/rating.json")), Contains("reference/lab.001"));
  CHECK_THAT(folder.run("rate lab/lab.mme run/Channel/run.001").text,
             Contains("Warning: the channels were filtered differently: ") &&
                 Contains("unfiltered by its channel code"));
}

TEST_CASE("'flexneck nij' filters no load a second time that has passed CFC 600 by its code") {
  const RatedFolder folder;
  const Eigen::Index count = 400;
  const VectorXd spike = 3000 * VectorXd::Unit(count, 200);
  const auto write = [&](char filter, const VectorXd& force) {
    pipeline::MmeTest test;
    const VectorXd none = VectorXd::Zero(count);
    test.channels = {{std::string("11NECKUP00H3FOZ") + filter, "", "N", 0, kInterval_s, force},
                     {"11NECKUP00H3MOYB", "", "N*m", 0, kInterval_s, none},
                     {"11NECKUP00H3FOXA", "", "N", 0, kInterval_s, none},
                     {"11NECKUP00H3FOXB", "", "N", 1e-3, kInterval_s, none}};
    pipeline::write_mme_test(folder.path("lab/lab.mme"), test);
    return std::string("nij lab --moment 11NECKUP00H3MOYB --force 11NECKUP00H3FOZ") + filter;
  };
  const auto nij = [&](double force) { return fmt::format("Nij      {:.6f}", force / 6806); };
  const VectorXd once =
      multibody::cfc_filtered(spike, kInterval_s, multibody::ChannelClass::cfc600);
  for (const char* const shear : {"", " --shear 11NECKUP00H3FOXA"}) {
    CHECK_THAT(folder.run(write('A', spike) + shear).text, Contains(nij(once.maxCoeff())));
    CHECK_THAT(folder.run(write('B', spike) + shear).text, Contains(nij(3000)));
  }
  check_refused(folder.run(write('C', spike)), "CFC 600 cannot be obtained");
  check_refused(folder.run(write('A', spike) + " --shear 11NECKUP00H3FOXB"),
                "expected the times of");
  check_refused(folder.run(write('A', spike) + " --shear 11NECKUP00H3MOYB"), "another dimension");
}

TEST_CASE("'flexneck nij' gives the four combinations of loads in a file") {
  const RatedFolder folder;
  const auto constant = [](double value) { return VectorXd(VectorXd::Constant(400, value)); };
  // Loads in other units; half an intercept each: 6806 N / 2, -135 N m / 2.
  const double lbf = 4.4482216152605;
  folder.write("loads.csv", table("time [ms],Fz [lbf],My [N*m],Fx [kN]",
                                  {constant(3403 / lbf), constant(-67.5), constant(1)}, 0.1));
  const std::string command = "nij loads.csv --force Fz --moment My";
  const CommandOutcome outcome = folder.run(command + " -o out");
  INFO(outcome.text);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.text, Contains("NTE      1.000000") && Contains("NCF      0.000000") &&
                               Contains("Nij      1.000000") &&
                               Contains("not defined for pendulum"));
  CHECK(names_in(folder.path("out")) == std::vector<std::string>{"nij.json"});
  // The shear force has an arm of 17.78 mm: -67.5 N m - 17.78 N m.
  CHECK_THAT(folder.run(command + " --shear Fx").text,
             Contains(fmt::format("{:.6f}", 0.5 + 85.28 / 135)));
  CHECK_THAT(folder.run(command + " --dummy 5th-female").text,
             Contains(fmt::format("{:.6f}", 3403 / 4287.0 + 67.5 / 67)));

  check_refused(folder.run("nij loads.csv --force Fz"), "--moment is required");
  check_refused(folder.run("nij --force Fz --moment My"), "expected one file");
  check_refused(folder.run("nij loads.csv --force My --moment My"), "another dimension");
  check_refused(folder.run(command + " --dummy 95th"), "dummy");
  check_refused(folder.run(command + " --from 1s"), "--from is an option of the command rate");
  folder.write("loads.csv", table("time [ms],Fz [N],My [N*m]", {constant(1), constant(1)}, 0.2));
  check_refused(folder.run(command), "loads.csv: CFC 600 needs at least 6000 samples");
  folder.write("loads.csv", "time [s],Fz [N],My [N*m]\n0,1,1\n1e-4,1,1\n3e-4,2,2\n");
  check_refused(folder.run(command), "samples at equal intervals");
  folder.write("loads.csv", "0,1\n1,2\n");
  check_refused(folder.run(command), "expected a header line with the names");
}
