// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/process/customary_units.h"

#include <map>

#include "geometry/foundation/units.h"

namespace flexneck::pipeline {

std::string customary_unit(const std::string& si_unit, const std::string& moment_unit) {
  if (si_unit == "N*m") return moment_unit;
  static const std::map<std::string, std::string> units = {
      {"rad", "deg"}, {"m", "in"}, {"m/s", "in/s"}, {"m/s^2", "gn"}, {"N", "lbf"}};
  const auto found = units.find(si_unit);
  return found == units.end() ? si_unit : found->second;
}

std::vector<multibody::Channel> in_customary_units(std::vector<multibody::Channel> channels,
                                                   const char* moment_unit) {
  for (multibody::Channel& channel : channels) {
    const std::string customary = customary_unit(channel.unit, moment_unit);
    if (customary == channel.unit) continue;
    channel.values *= factor_from_si(channel.unit, customary);
    channel.unit = customary;
  }
  return channels;
}

}  // namespace flexneck::pipeline
