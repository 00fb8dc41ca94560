// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/laboratory/iso_mme/channel_file.h"

#include <cmath>

#include "geometry/foundation/error.h"
#include "geometry/foundation/printable.h"
#include "geometry/foundation/units.h"
#include "pipeline/laboratory/iso_mme/channel_code.h"
#include "pipeline/laboratory/iso_mme/descriptor_file.h"

namespace flexneck::pipeline {

using Eigen::Index;

namespace {

std::string read_code(const DescriptorFile& file) {
  const DescriptorFile::Line& line = file.need("Channel code");
  if (!is_mme_code(line.text))
    file.refuse(line,
                "expected a channel code of 16 letters and digits such as 11NECKUP00H3MOYB, "
                "found \"" +
                    printable(line.text) + "\"");
  return line.text;
}

std::string read_unit(const DescriptorFile& file, const std::string& code) {
  const DescriptorFile::Line* const line = file.find("Unit");
  if (line == nullptr) return {};
  std::string unit = unit_from_mme(line->text, code);
  const std::string si_unit(mme_si_unit(code));
  if (si_unit.empty()) return unit;
  try {
    factor_from_si(si_unit, unit);
  } catch (const InputError& error) {
    file.refuse(*line, "channel " + code + ": " + error.what());
  }
  return unit;
}

/// Refuses a channel whose times are not at equal intervals but in a channel of their own.
void refuse_other_times(const DescriptorFile& file) {
  const DescriptorFile::Line* const line = file.find("Reference channel");
  if (line != nullptr && line->text != "implicit")
    file.refuse(*line,
                "expected the times by 'Time of first sample' and 'Sampling interval' (Reference "
                "channel implicit), found \"" +
                    printable(line->text) + "\"");
}

Eigen::VectorXd read_samples(const DescriptorFile& file) {
  const auto lines = file.samples();
  const double count = file.number("Number of samples");
  if (count != static_cast<double>(lines.size()))
    file.refuse(file.need("Number of samples"),
                "expected as many samples as the header says, found " +
                    std::to_string(lines.size()) + "; the file may be truncated");
  if (lines.size() < 2) file.refuse("expected at least two samples");
  Eigen::VectorXd values(static_cast<Index>(lines.size()));
  for (Index k = 0; k < values.size(); ++k)
    values[k] = file.number(lines[static_cast<std::size_t>(k)]);
  return values;
}

/// Fails unless the samples' times differ: an interval may be lost in a large first time.
void require_times(const DescriptorFile& file, const MmeChannel& channel) {
  const DescriptorFile::Line& line = file.need("Sampling interval");
  if (!(channel.interval_s > 0))
    file.refuse(line, "expected a positive interval in s, found " + printable(line.text));
  const Eigen::VectorXd time_s = channel.time_s();
  const Index last = time_s.size() - 1;
  if (!time_s.allFinite() || ((time_s.tail(last) - time_s.head(last)).array() <= 0).any())
    file.refuse(line, "expected increasing times, but " + printable(line.text) +
                          " s is too small or too large for the time of the first sample");
}

}  // namespace

Eigen::VectorXd MmeChannel::time_s() const {
  Eigen::VectorXd times_s(values.size());
  for (Index k = 0; k < times_s.size(); ++k)
    times_s[k] = first_s + static_cast<double>(k) * interval_s;
  return times_s;
}

MmeChannel read_mme_channel_file(const std::filesystem::path& path) {
  const DescriptorFile file(path);
  MmeChannel channel;
  channel.code = read_code(file);
  if (const auto* const line = file.find("Name of the channel")) channel.name = line->text;
  channel.unit = read_unit(file, channel.code);
  refuse_other_times(file);
  channel.first_s = file.number("Time of first sample");
  channel.interval_s = file.number("Sampling interval");
  channel.values = read_samples(file);
  require_times(file, channel);
  return channel;
}

}  // namespace flexneck::pipeline
