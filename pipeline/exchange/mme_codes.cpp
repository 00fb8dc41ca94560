// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/exchange/mme_codes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "pipeline/laboratory/iso_mme/channel_code.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Kind = CaseSection::Kind;

namespace {

/// Row of the table of codes. Test object D is the dummy, P the pendulum, T the test rig; TMON is
/// the total moment, i.e. the moment at the condyles; SFAD applies a static force. Direction 1 or 2
/// is X or Y with a sign opposite to SAE J211; 0 is none of the dummy's axes. Rotations here are
/// positive towards the side that the head tips to, which is negative about the axes of J211; y
/// points left here, right in J211. Moments have the signs of J211.
struct CodeRow {
  Kind kind;
  std::string_view channel;
  std::string_view place;  ///< codes from the test object to fine location 2
  bool has_dummy;          ///< fine location 3 is the dummy; else 00
  std::string_view dimension;
  char fore_aft, lateral;  ///< direction code in each plane
};
constexpr std::array<CodeRow, 13> kCodes = {{
    {Kind::pendulum, "head rotation", "D0HEAD0000", true, "AN", '2', '1'},
    {Kind::pendulum, "neck rotation", "D0NECK0000", true, "AN", '2', '1'},
    {Kind::pendulum, "head acceleration", "D0HEADCG00", true, "AC", '0', '0'},
    {Kind::pendulum, "head acceleration filtered", "D0HEADCG00", true, "AC", '0', '0'},
    {Kind::pendulum, "base moment", "D0NECKLO00", true, "MO", 'Y', 'X'},
    {Kind::pendulum, "occipital moment", "D0TMONUP00", true, "MO", 'Y', 'X'},
    {Kind::pendulum, "load cell moment", "D0TMONUP00", true, "MO", 'Y', 'X'},
    {Kind::pendulum, "arm velocity", "P000000000", false, "VE", 'X', 'X'},
    {Kind::pendulum, "arm deceleration", "P000000000", false, "AC", '1', '1'},
    {Kind::static_test, "load", "T0SFAD0000", false, "FO", '0', '0'},
    {Kind::static_test, "rotation", "D0NECKUP00", true, "AN", '2', '1'},
    {Kind::static_test, "deflection", "D0NECKUP00", true, "DS", 'X', '2'},
    {Kind::static_test, "base moment", "D0NECKLO00", true, "MO", 'Y', 'X'},
}};

struct DummyCode {
  std::string_view name, code;
};
constexpr std::array<DummyCode, 3> kDummies = {{
    {"Hybrid III 50th male", "H3"},
    {"Hybrid III 5th female", "HF"},
    {"Hybrid III six-year-old", "Y7"},
}};

std::string_view dummy_code(const std::string& name) {
  for (const DummyCode& each : kDummies)
    if (each.name == name) return each.code;
  return "00";
}

const CodeRow* row_of(const multibody::Channel& channel, const CaseSection& experiment) {
  const auto found = std::find_if(kCodes.begin(), kCodes.end(), [&](const CodeRow& row) {
    return row.kind == experiment.kind && row.channel == channel.name;
  });
  return found != kCodes.end() && channel.columns.size() == 1 ? &*found : nullptr;
}

bool is_own_code(const multibody::Channel& channel) {
  return channel.columns.size() == 1 && is_mme_code(channel.name) &&
         mme_si_unit(channel.name) == channel.unit &&
         channel.name.back() == mme_filter_letter(channel.filter);
}

/// Number of outputs at equal intervals; the last interval may be shorter.
Index equal_outputs(const Eigen::VectorXd& time_s) {
  constexpr double kSame = 1e-6;  // fraction of an interval
  const Index count = time_s.size();
  if (count < 2) throw InputError("expected at least two outputs");
  const double interval_s = time_s[1] - time_s[0];
  Index k = 2;
  while (k < count && std::abs(time_s[0] + static_cast<double>(k) * interval_s - time_s[k]) <=
                          kSame * interval_s)
    ++k;
  if (k + 1 < count)
    throw InputError(
        fmt::format("an ISO-MME test needs outputs at equal intervals, here {:g} s, but one at "
                    "{:g} s follows one at {:g} s",
                    interval_s, time_s[k], time_s[k - 1]));
  return k;
}

}  // namespace

std::vector<std::string> mme_codes(const multibody::Channel& channel, const MmeSource& source,
                                   int& number) {
  constexpr int kMaxNumber = 999;
  const char filter = mme_filter_letter(channel.filter);
  if (source.experiment != nullptr) {
    const CaseSection& experiment = *source.experiment;
    // The standard has directions along axes only.
    const bool has_code = experiment.direction != CaseSection::Direction::oblique;
    if (const CodeRow* const row = has_code ? row_of(channel, experiment) : nullptr) {
      const bool lateral = experiment.direction == CaseSection::Direction::lateral;
      return {fmt::format("{}{}{}{}{}", row->place,
                          row->has_dummy ? dummy_code(source.dummy) : "00", row->dimension,
                          lateral ? row->lateral : row->fore_aft, filter)};
    }
  }
  if (is_own_code(channel)) return {channel.name};
  std::vector<std::string> codes;
  for (std::size_t column = 0; column < channel.columns.size(); ++column) {
    if (++number > kMaxNumber)
      throw InputError(fmt::format(
          "expected at most {} channels without a standard code; use fewer channels in the model",
          kMaxNumber));
    codes.push_back(
        fmt::format("002{:03}000000{}0{}", number, mme_dimension(channel.unit), filter));
  }
  return codes;
}

std::vector<MmeChannel> mme_channels(const multibody::HistoryFile& run, const MmeSource& source,
                                     std::vector<std::string>& left_out) {
  const Eigen::VectorXd& time_s = run.history.time_s;
  const Index count = equal_outputs(time_s);
  if (count < time_s.size())
    left_out.push_back(
        fmt::format("the output at {:g} s is not carried over, since its interval to the output "
                    "before it is shorter than the others",
                    time_s[count]));
  int number = 0;
  std::vector<MmeChannel> channels;
  for (const multibody::Channel& channel : run.channels) {
    const std::vector<std::string> codes = mme_codes(channel, source, number);
    for (std::size_t column = 0; column < codes.size(); ++column) {
      const std::string name =
          channel.name + (codes.size() == 1 ? "" : " " + channel.columns[column]);
      channels.push_back({codes[column], name, channel.unit, time_s[0], time_s[1] - time_s[0],
                          channel.values.row(static_cast<Index>(column)).head(count).transpose()});
    }
  }
  return channels;
}

}  // namespace flexneck::pipeline
