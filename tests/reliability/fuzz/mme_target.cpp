// SPDX-License-Identifier: GPL-3.0-or-later
// Target: tests of ISO-MME. The input is the index and, after a line of equals signs, the file of a
// channel; a channel that was read is written and read again.
#include <bit>
#include <cstdint>

#include "pipeline/laboratory/curve_file.h"
#include "pipeline/laboratory/iso_mme/channel_text.h"
#include "pipeline/laboratory/iso_mme/test_folder.h"
#include "tests/reliability/fuzz/input_folder.h"

using namespace flexneck;

namespace {

constexpr std::string_view kBreak = "====\n";

bool same_bits(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  if (a.size() != b.size()) return false;
  for (Eigen::Index k = 0; k < a.size(); ++k)
    if (std::bit_cast<std::uint64_t>(a[k]) != std::bit_cast<std::uint64_t>(b[k])) return false;
  return true;
}

void check_curve(const std::filesystem::path& path) {
  const pipeline::Curve curve = pipeline::read_curve(path, "");
  fuzz::require(curve.time_s.size() > 1 && curve.time_s.size() == curve.values.size(),
                "times and values have one length");
  fuzz::require(curve.time_s.allFinite() && curve.values.allFinite(), "a channel is finite");
  for (Eigen::Index k = 1; k < curve.time_s.size(); ++k)
    fuzz::require(curve.time_s[k] > curve.time_s[k - 1], "times increase strictly");
  fuzz::require(curve.filter.has_value(), "a code tells the filter");
  const pipeline::MmeChannel channel = pipeline::read_mme_channel(curve.source, "").channel;
  static const fuzz::InputFolder again;
  const pipeline::MmeChannel back =
      pipeline::read_mme_channel(again.with("again.001", pipeline::mme_channel_text(channel)), "")
          .channel;
  fuzz::require(
      same_bits(back.values, channel.values) && same_bits(back.time_s(), channel.time_s()),
      "a channel is read back as it was written");
  fuzz::require(back.code == channel.code && back.unit == channel.unit,
                "code and unit are read back as they were written");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFolder folder;
  folder.with("test.mme", "Title :x\n");
  const std::string text = fuzz::text_of(data, size);
  const std::size_t at = text.find(kBreak);
  const bool has_index = at != std::string::npos;
  if (has_index) folder.with("test.chn", text.substr(0, at));
  folder.with("test.001", has_index ? text.substr(at + kBreak.size()) : text);
  return fuzz::try_reader(
      [&] { check_curve(folder.path() / (has_index ? "test.mme" : "test.001")); });
}
