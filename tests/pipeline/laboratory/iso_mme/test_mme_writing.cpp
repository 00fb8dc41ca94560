// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "pipeline/exchange/mme_codes.h"
#include "pipeline/experiments/pendulum_signals.h"
#include "pipeline/laboratory/curve_file.h"
#include "pipeline/laboratory/iso_mme/channel_code.h"
#include "pipeline/laboratory/iso_mme/test_folder.h"
#include "pipeline/laboratory/iso_mme/test_writer.h"
#include "tests/pipeline/laboratory/iso_mme/mme_folder.h"
#include "tests/support/coarse_neck.h"
#include "tests/support/files.h"
#include "tests/support/flexneck_command.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::pipeline;
using Eigen::VectorXd;
using testing::bytes_of;
using testing::check_refused;
using testing::names_in;
using testing::run_flexneck;

namespace fs = std::filesystem;

namespace {

bool same_bits(const VectorXd& a, const VectorXd& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) {
           return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
         });
}

/// Numbers of all magnitudes, with zeros of both signs and the smallest and largest doubles.
VectorXd any_numbers(Eigen::Index count) {
  std::mt19937_64 random(1);
  VectorXd values(count);
  for (double& value : values) {
    do value = std::bit_cast<double>(random());
    while (!std::isfinite(value));
  }
  values.head<5>() << 0.0, -0.0, std::numeric_limits<double>::denorm_min(),
      std::numeric_limits<double>::max(), -std::numeric_limits<double>::min();
  return values;
}

multibody::HistoryFile run_of(const std::vector<multibody::Channel>& channels, double last_s) {
  multibody::HistoryFile run;
  run.history.time_s.resize(4);
  run.history.time_s << 0, 0.1, 0.2, last_s;
  run.channels = channels;
  return run;
}

multibody::Channel channel(const std::string& name, const std::string& unit,
                           const std::string& filter = "",
                           const std::vector<std::string>& columns = {""}) {
  return {name, unit, columns, Eigen::MatrixXd::Ones(static_cast<Eigen::Index>(columns.size()), 4),
          filter};
}

std::vector<std::string> codes_of(const multibody::Channel& channel, const MmeSource& source) {
  int number = 0;
  return mme_codes(channel, source, number);
}

}  // namespace

TEST_CASE("what is written is read back to the last bit, and the same makes the same files") {
  const TemporaryFolder folder;
  const fs::path path = folder / "lab 7/lab 7.mme";
  MmeTest test{"seven", "simulation", "", {"a", "b: c"}, {}};
  test.channels = {{"11NECKUP00H3MOYB", "moment", "N*m", -0.0375, 1 / 3e4, any_numbers(2000)},
                   {"11HEADCG00H3ACXA", "head: x", "m/s^2", 0, 1e-4, any_numbers(7)},
                   {"00200100000000X0", "", "1", 1e9, 0.25, any_numbers(5)}};
  write_mme_test(path, test);
  for (const MmeChannel& each : test.channels) {
    const MmeChannel back = read_mme_channel(folder / "lab 7", each.code).channel;
    CHECK(same_bits(back.values, each.values));
    CHECK(same_bits(back.time_s(), each.time_s()));
    CHECK(back.unit == each.unit);
    CHECK(back.name == each.name);
  }
  CHECK(names_in(folder / "lab 7/Channel") ==
        std::vector<std::string>{"lab 7.001", "lab 7.002", "lab 7.003", "lab 7.chn"});
  const std::string first = bytes_of(folder / "lab 7/Channel/lab 7.001");
  test.channels.resize(1);
  write_mme_test(path, test);  // replaces the first one
  CHECK(names_in(folder / "lab 7/Channel") == std::vector<std::string>{"lab 7.001", "lab 7.chn"});
  CHECK(bytes_of(folder / "lab 7/Channel/lab 7.001") == first);
  CHECK(names_in(folder.path()) == std::vector<std::string>{"lab 7"});
}

TEST_CASE("keys of the files are filled up to 28 characters, then comes the colon") {
  const TemporaryFolder folder;
  write_mme_test(
      folder / "a/a.mme",
      {"a", "", "", {}, {{"11NECKUP00H3MOYB", "moment", "N*m", 0, 1e-4, VectorXd::Ones(2)}}});
  for (const char* const name : {"a/a.mme", "a/Channel/a.chn", "a/Channel/a.001"}) {
    std::istringstream lines(bytes_of(folder / name));
    for (std::string line; std::getline(lines, line) && line.find(':') != std::string::npos;)
      CHECK(line.find(':') == 28);
  }
  const std::string text = bytes_of(folder / "a/Channel/a.001");
  CHECK_THAT(text, Contains("Unit                        :Nm\n") &&
                       Contains("Channel frequency class     :600\n") &&
                       Contains("Number of samples           :2\n"));
}

TEST_CASE("a folder that holds anything else is left as it is") {
  const TemporaryFolder folder;
  const MmeTest test{
      "a", "", "", {}, {{"11NECKUP00H3MOYB", "", "N*m", 0, 1e-4, VectorXd::Ones(2)}}};
  CHECK_THROWS_WITH(write_mme_test(folder / "a.mme", test),
                    Contains("is written to a folder of the same name"));
  CHECK_THROWS_WITH(write_mme_test(folder / "b/a/a.mme", test), Contains("cannot be written"));
  fs::create_directory(folder / "a");
  testing::write_test_file(folder / "a/notes.txt", "mine");
  CHECK_THROWS_WITH(write_mme_test(folder / "a/a.mme", test), Contains("found notes.txt in it"));
  CHECK(names_in(folder / "a") == std::vector<std::string>{"notes.txt"});
  CHECK(names_in(folder.path()) == std::vector<std::string>{"a"});
  testing::write_test_file(folder / "c", "a file");
  CHECK_THROWS_WITH(write_mme_test(folder / "c/c.mme", test), Contains("expected a folder"));
  CHECK_THROWS_WITH(write_mme_test(folder / "d/d.mme", {"d", "", "", {}, {}}),
                    Contains("expected 1 to 999 channels, found 0"));
  CHECK_FALSE(fs::exists(folder / "d"));
}

TEST_CASE("channels of cases have codes of the standard, by plane and filter") {
  CaseSection experiment;
  experiment.kind = CaseSection::Kind::pendulum;
  const MmeSource source{&experiment, "Hybrid III 50th male"};
  const auto code = [&](const std::string& name, const std::string& unit,
                        const std::string& filter = "") {
    return codes_of(channel(name, unit, filter), source).at(0);
  };
  CHECK(code("base moment", "N*m") == "D0NECKLO00H3MOY0");
  CHECK(code("head acceleration filtered", "m/s^2", "CFC 1000") == "D0HEADCG00H3AC0A");
  CHECK(code("load cell moment", "N*m", "CFC 600") == "D0TMONUP00H3MOYB");
  CHECK(code("load cell moment", "N*m", "CFC 600, force CFC 1000") == "D0TMONUP00H3MOY2");
  CHECK(code("arm velocity", "m/s") == "P00000000000VEX0");
  CHECK(code("head rotation", "rad") == "D0HEAD0000H3AN20");
  experiment.direction = CaseSection::Direction::lateral;
  CHECK(code("head rotation", "rad") == "D0HEAD0000H3AN10");
  CHECK(code("base moment", "N*m") == "D0NECKLO00H3MOX0");
  experiment.kind = CaseSection::Kind::static_test;
  CHECK(codes_of(channel("deflection", "m"), {&experiment, "Hybrid III 5th female"}).at(0) ==
        "D0NECKUP00HFDS20");
  CHECK(code("load", "N") == "T0SFAD000000FO00");
  CHECK(codes_of(channel("rotation", "rad"), {&experiment, "my own"}).at(0) == "D0NECKUP0000AN10");
}

TEST_CASE("other channels have codes of a laboratory, or the code that is their name") {
  std::vector<std::string> left_out;
  const auto run = run_of(
      {channel("tip", "m", "", {"x", "y", "z"}), channel("11NECKUP00H3MOYB", "N*m", "CFC 600"),
       channel("11NECKLO00H3MOYB", "N*m"), channel("head rotation", "rad")},
      0.25);
  const std::vector<MmeChannel> channels = mme_channels(run, {}, left_out);
  std::vector<std::string> codes;
  for (const MmeChannel& each : channels) {
    CHECK(is_mme_code(each.code));
    codes.push_back(each.code);
  }
  CHECK(codes == std::vector<std::string>{"002001000000DS00", "002002000000DS00",
                                          "002003000000DS00", "11NECKUP00H3MOYB",
                                          "002004000000MO00", "002005000000AN00"});
  CHECK(channels[1].name == "tip y");
  // The last output is closer, which equal intervals cannot represent.
  CHECK(channels[0].values.size() == 3);
  REQUIRE(left_out.size() == 1);
  CHECK_THAT(left_out[0], Contains("the output at 0.25 s is not carried over"));
  auto uneven = run;
  uneven.history.time_s << 0, 0.1, 0.15, 0.3;
  CHECK_THROWS_WITH(mme_channels(uneven, {}, left_out), Contains("at equal intervals"));
  left_out.clear();
  CHECK(mme_channels(run_of({channel("a", "N")}, 0.3), {}, left_out)[0].values.size() == 4);
  CHECK(left_out.empty());
  const std::vector<std::string> many(1000, "x");
  CHECK_THROWS_WITH(codes_of(channel("many", "m", "", many), {}), Contains("at most 999 channels"));
}

TEST_CASE("'flexneck export' writes a run, and a rating reads it again") {
  const TemporaryFolder folder;
  const std::string in = folder.path().string();
  testing::write_test_file(folder / "swing.toml", testing::double_pendulum_text());
  REQUIRE(run_flexneck("simulate -q " + in + "/swing.toml -o " + in + "/out").exit_code == 0);
  const std::string run = in + "/out/swing.h5";
  const auto outcome = run_flexneck("export " + run + " --to " + in + "/swing/swing.mme");
  INFO(outcome.text);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.text, Contains("002001000000"));
  const auto csv = read_curve(folder / "out/swing.csv",
                              read_mme_channel(folder / "swing", "002001000000DS00").channel.name);
  const Curve back = read_curve(folder / "swing", "002001000000DS00");
  CHECK(same_bits(csv.values.head(back.values.size()), back.values));
  check_refused(run_flexneck("export -q " + run + " --to " + in + "/swing.mme"),
                "a folder of the same name");
  check_refused(run_flexneck("export -q " + run + " --to " + in + "/swing.msh"),
                ".mme (channels of a run as an ISO-MME test)");
  check_refused(run_flexneck("export -q --to " + in + "/swing/swing.mme"),
                "name the file to export");
  check_refused(run_flexneck("export -q " + run), "expected --to FILE");
  check_refused(run_flexneck("export -q " + run + " --set a=1 --to " + in + "/b/b.mme"), "--set");
  check_refused(run_flexneck("export -q " + run + " " + run + " --to " + in + "/b/b.mme"),
                "expected one file");
  check_refused(run_flexneck("export -q " + in + "/no.h5 --to " + in + "/b/b.mme"), "no.h5");
  CHECK_FALSE(fs::exists(folder / "b"));
}

TEST_CASE(
    "a case is exported with the dummy and the plane of the study that its folder remembers") {
  const TemporaryFolder folder;
  const std::string out = " -q -o " + (folder / "out").string();
  REQUIRE(run_flexneck("mesh" + out + testing::kCoarseNeck).exit_code == 0);
  REQUIRE(run_flexneck("modes" + out).exit_code == 0);
  REQUIRE(run_flexneck("pendulum --case lateral-65" + out).exit_code == 0);
  const fs::path run = folder / "out/pendulum-lateral-65.h5";
  const std::string to = "export -q " + run.string() + " --to " + (folder / "lab/lab.mme").string();
  REQUIRE(run_flexneck(to).exit_code == 0);
  const multibody::HistoryFile history = multibody::read_history(run);
  for (const auto& [code, channel] : {std::pair("D0TMONUP00H3MOXB", "load cell moment"),
                                      std::pair("D0HEADCG00H3AC0A", "head acceleration filtered"),
                                      std::pair("D0HEAD0000H3AN10", "head rotation")}) {
    const Curve curve = read_curve(folder / "lab", code);
    CHECK(same_bits(curve.values, channel_named(history.channels, channel)));
    // The run's own times are sums of shorter steps.
    CHECK((curve.time_s - history.history.time_s).cwiseAbs().maxCoeff() < 1e-15);
  }
  const std::string bytes = bytes_of(folder / "lab/Channel/lab.001");
  REQUIRE(run_flexneck(to).exit_code == 0);
  CHECK(bytes_of(folder / "lab/Channel/lab.001") == bytes);
  // The folder's study has changed since.
  REQUIRE(
      run_flexneck("mesh --set body.head.mass='4.8 kg'" + out + testing::kCoarseNeck).exit_code ==
      0);
  check_refused(run_flexneck(to), "was made with body.head.mass");
}
