// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "pipeline/laboratory/curve_file.h"
#include "pipeline/laboratory/iso_mme/channel_code.h"
#include "pipeline/laboratory/iso_mme/test_folder.h"
#include "pipeline/language/model/csv_table.h"
#include "tests/pipeline/laboratory/iso_mme/mme_folder.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::pipeline;
using multibody::ChannelClass;
using testing::kMmeAcceleration;
using testing::kMmeIndex;
using testing::kMmeMoment;
using testing::kMmeTest;
using testing::MmeFolder;
using testing::with;

namespace fs = std::filesystem;

namespace {

const std::string kMoment = "11NECKUP00H3MOYP";

/// Checks that a test with another file of the moment is refused.
void refuses(const std::string& text, const std::string& reason) {
  const MmeFolder folder;
  folder.write("Channel/test.001", text);
  INFO(text);
  CHECK_THROWS_WITH(read_curve(folder.path(), kMoment), Contains("test.001") && Contains(reason));
}

}  // namespace

TEST_CASE("a channel of a test is its samples over its times, however the test is named") {
  const MmeFolder folder;
  for (const char* const name : {"", "test.mme", "Channel/test.chn", "Channel/test.001"}) {
    const fs::path path = *name == '\0' ? folder.path() : folder / name;
    const Curve curve = read_curve(path, kMoment);
    CHECK(curve.unit == "N*m");
    CHECK(curve.column == kMoment);
    CHECK(curve.source == folder / "Channel/test.001");
    CHECK(curve.values ==
          (Eigen::VectorXd(6) << -6.774550e-4, -6.774550e-4, 0, 8.21e-3, 1.642828e-2, 1.5e-2)
              .finished());
    CHECK(curve.time_s[0] == -0.0002);
    CHECK(curve.time_s[5] == Approx(0.0003).epsilon(1e-12));
  }
  // A single channel needs no code.
  folder.write("Channel/test.chn",
               with(with(kMmeIndex, ":2\n", ":1\n"),
                    "Name of channel 002         :11HEADCG00H3ACXA / Head CG\n", ""));
  CHECK(read_curve(folder.path(), "").column == kMoment);
  CHECK(read_curve(folder / "Channel/test.002", "").column == "11HEADCG00H3ACXA");
}

TEST_CASE("folders and files are found in capitals, too, and the index beside the test") {
  const MmeFolder folder;
  fs::rename(folder / "Channel/test.chn", folder / "Channel/TEST.CHN");
  fs::rename(folder / "Channel/test.001", folder / "Channel/TEST.001");
  fs::rename(folder / "Channel", folder / "CHANNEL");
  fs::rename(folder / "test.mme", folder / "test.MME");
  CHECK(read_curve(folder.path(), kMoment).values.size() == 6);
  for (const char* const name : {"TEST.CHN", "TEST.001"})
    fs::rename(folder / "CHANNEL" / name, folder / name);
  fs::remove_all(folder / "CHANNEL");
  CHECK(read_curve(folder / "test.MME", kMoment).values.size() == 6);
}

TEST_CASE("files may be of any of four encodings, with either line end") {
  // "Moment d'été °" and a quotation mark of Windows-1252.
  for (const char* const name : {"Moment", "Moment d'\xe9t\xe9 \xb0", "Moment \x93y\x94 \x80",
                                 "Moment d'\u00e9t\u00e9 \u201cy\u201d"}) {
    const MmeFolder folder;
    std::string text = with(kMmeMoment, "Neck Upper Moment Y", name);
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
      text.replace(at, 1, "\r\n");
    folder.write("Channel/test.001", text);
    folder.write("test.mme", with(kMmeTest, "a made-up test", name));
    folder.write("Channel/test.chn", with(kMmeIndex, "Neck Upper Moment Y", name));
    CHECK(read_curve(folder.path(), kMoment).values[4] == 1.642828e-2);
  }
  const MmeFolder folder;
  folder.write("Channel/test.001", with(kMmeMoment, "Neck Upper", "\xe9t\xe9 \x93\xb5\x94"));
  CHECK(read_mme_channel(folder.path(), kMoment).channel.name ==
        "\u00e9t\u00e9 \u201c\u00b5\u201d Moment Y");
}

TEST_CASE("units of the standard and others of the same dimension are taken, gravity among them") {
  const MmeFolder folder;
  const Curve head = in_unit(read_curve(folder.path(), "11HEADCG00H3ACXA"), "m/s^2");
  CHECK(head.values[0] == Approx(9.80665).epsilon(1e-15));
  const auto unit = [&](const std::string& text) {
    folder.write("Channel/test.002", with(kMmeAcceleration, ":g\n", ":" + text + "\n"));
    return in_unit(read_curve(folder.path(), "11HEADCG00H3ACXA"), "m/s^2").values[0];
  };
  CHECK(unit("G") == Approx(9.80665).epsilon(1e-15));
  CHECK(unit("m/(s*s)") == 1);
  CHECK(unit("m/s\xb2") == 1);
  CHECK(unit("mm/s^2") == Approx(1e-3).epsilon(1e-15));
  CHECK_THROWS_WITH(unit("m/s"), Contains("test.002:4: channel 11HEADCG00H3ACXA: ") &&
                                     Contains("has another dimension"));
  refuses(with(kMmeMoment, ":Nm", ":lbf"), "has another dimension");
  refuses(with(kMmeMoment, ":Nm", ":furlong-ish"), "expected a unit");
  CHECK_THROWS_WITH(in_unit(read_curve(folder.path(), kMoment), "N"),
                    Contains("another dimension"));
  folder.write("Channel/test.001", with(kMmeMoment, ":Nm", ":NOVALUE"));
  CHECK(read_curve(folder.path(), kMoment).unit.empty());
  CHECK(unit_to_mme("m/s^2") == "m/(s*s)");
  CHECK(unit_to_mme("deg") == "deg");
  CHECK(unit_from_mme("\u00b0/s", "11HEADCG00H3AVYA") == "deg/s");
}

TEST_CASE("the last letter of a code says what the channel has passed, and it is not done again") {
  const MmeFolder folder;
  const auto needs = [&](char letter, ChannelClass wanted) {
    const std::string code = "11NECKUP00H3MOY" + std::string(1, letter);
    folder.write("Channel/test.001", with(kMmeMoment, kMoment, code));
    return needs_filter(read_curve(folder / "Channel/test.001", code), wanted);
  };
  for (const char open : {'0', 'P', 'V', 'X', 'A'}) CHECK(needs(open, ChannelClass::cfc600));
  for (const char passed : {'B', 'F'}) CHECK_FALSE(needs(passed, ChannelClass::cfc600));
  CHECK(needs('B', ChannelClass::cfc180));
  CHECK_FALSE(needs('D', ChannelClass::cfc60));
  for (const char narrow : {'C', 'D', 'L', 'S', '2', 'k'})
    CHECK_THROWS_WITH(needs(narrow, ChannelClass::cfc600), Contains("CFC 600 cannot be obtained"));
  // A CSV file does not state its filter.
  folder.write("plain.csv", "time [s],a [N]\n0,1\n1,2\n");
  CHECK(needs_filter(read_curve(folder / "plain.csv", ""), ChannelClass::cfc60));
}

TEST_CASE("a table over time may be a channel, one over anything else not") {
  const MmeFolder folder;
  const TableColumns columns = read_csv_columns(folder.path(), "s", "N*m", kMoment);
  CHECK(columns.x.front() == -0.0002);
  CHECK(columns.y.at(3) == 8.21e-3);
  CHECK_THROWS_WITH(read_csv_columns(folder.path(), "m", "N*m", kMoment),
                    Contains("whose channels are over time"));
  CHECK_THROWS_WITH(read_csv_columns(folder.path(), "s", "N", kMoment),
                    Contains("another dimension"));
}

TEST_CASE("a channel's file that cannot be is refused with its line") {
  refuses("", "expected a line \"Channel code :");
  refuses(with(kMmeMoment, kMoment, "NECKUP"), "001:1: expected a channel code of 16 letters");
  refuses(with(kMmeMoment, kMoment, "11NECKUP-0H3MOYP"), "16 letters and digits");
  refuses(with(kMmeMoment, kMoment, "11NECKUP00H3FOZP"), "another dimension");
  refuses(with(with(kMmeMoment, kMoment, "11NECKUP00H3FOZP"), ":Nm", ":N"),
          "expected the channel '11NECKUP00H3MOYP', found '11NECKUP00H3FOZP'");
  refuses(with(kMmeMoment, ":implicit", ":explicit"), "001:2: expected the times by");
  refuses(with(kMmeMoment, ":0.0001\n", ":0\n"), "001:6: expected a positive interval in s");
  refuses(with(kMmeMoment, ":0.0001\n", ":-1e-4\n"), "expected a positive interval");
  refuses(with(kMmeMoment, ":0.0001\n", ":NOVALUE\n"), "expected a line \"Sampling interval :");
  refuses(with(kMmeMoment, ":0.0001\n", ":0,0001\n"), "001:6: expected a finite number");
  refuses(with(kMmeMoment, ":0.0001\n", ":1e-300\n"), "expected increasing times");
  refuses(with(kMmeMoment, ":0.0001\n", ":1e308\n"), "expected increasing times");
  refuses(with(kMmeMoment, "Time of first sample", "Time"), "\"Time of first sample :");
  refuses(with(kMmeMoment, "Time of first sample", ""), "001:8: expected \"Key :value\"");
  refuses(with(kMmeMoment, "Number of samples ", "Samples"), "\"Number of samples :");
  refuses(with(kMmeMoment, "8.210000E-3\n", ""), "001:9: expected as many samples as the header");
  refuses(kMmeMoment + "1\n", "found 7; the file may be truncated");
  refuses(kMmeMoment.substr(0, kMmeMoment.size() - 14), "found 5; the file may be truncated");
  refuses(kMmeMoment.substr(0, kMmeMoment.find("-6.77")), "found 0; the file may be truncated");
  refuses(with(kMmeMoment.substr(0, kMmeMoment.find("-6.77")), ":6\n", ":1\n") + "1\n",
          "expected at least two samples");
  refuses(with(kMmeMoment, "8.210000E-3", "NOVALUE"), "001:14: expected a sample, found NOVALUE");
  refuses(with(kMmeMoment, "8.210000E-3", "nan"),
          "001:14: expected a finite number, found \"nan\"");
  refuses(with(kMmeMoment, "8.210000E-3", "8,21E-3"), "expected a finite number");
  refuses(with(kMmeMoment, "8.210000E-3", "1e999"), "expected a finite number");
  refuses(with(kMmeMoment, "8.210000E-3", "Key :value"), "expected a finite number");
  refuses(with(kMmeMoment, "8.210000E-3", "8\x01"), "without control characters");
}

TEST_CASE("a test that is not whole is refused, and a code that is not there with the nearest") {
  const MmeFolder folder;
  const auto refused = [&](const std::string& name, const std::string& code,
                           const std::string& reason) {
    INFO(reason);
    CHECK_THROWS_WITH(read_curve(name.empty() ? folder.path() : folder / name, code),
                      Contains(reason));
  };
  refused("", "11NECKUP00H3MOYB", "(did you mean '11NECKUP00H3MOYP'?); there are:");
  refused("", "", "there are several channels; choose one of '11NECKUP00H3MOYP', '11HEADCG");
  refused("Channel/test.003", kMoment, "test.003: no such file");
  refused("Channel", kMoment,
          "expected a folder with one ISO-MME test, that is, one .mme file, found none");
  folder.write("Channel/test.chn", with(kMmeIndex, ":2\n", ":3\n"));
  refused("", kMoment, "test.chn:2: expected as many channels as the index says, found 2");
  folder.write("Channel/test.chn", with(kMmeIndex, kMoment, "11NECKUP"));
  refused("", kMoment, "test.chn:3: expected \"Name of channel 001 :CODE / name\"");
  folder.write("Channel/test.chn", with(kMmeIndex, "channel 001", "channel ../"));
  refused("", kMoment, "test.chn:3: expected \"Name of channel 001");
  folder.write("Channel/test.chn", with(kMmeIndex, "11HEADCG00H3ACXA", kMoment));
  refused("", kMoment, "there are several channels '11NECKUP00H3MOYP'");
  folder.write("Channel/test.chn", "Number of channels :0\n");
  refused("", kMoment, "test.chn: expected lines \"Name of channel");
  folder.write("Channel/test.chn", kMmeIndex);
  fs::remove(folder / "Channel/test.001");
  refused("", kMoment, "test.001: no such file");
  folder.write("other.mme", kMmeTest);
  refused("", kMoment, "found 2; name one of them");
  refused("other.mme", kMoment, "expected the channel index Channel/other.chn");
  folder.write("test.mme", "time [s],a [N]\n0,1\n");
  refused("test.mme", kMoment, "test.mme: expected an ISO-MME test with lines \"Key :value\"");
  refused("none.mme", kMoment, "none.mme: no such file");
}
