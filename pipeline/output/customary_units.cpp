// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/output/customary_units.h"

#include <string_view>
#include <utility>

#include "geometry/foundation/units.h"

namespace flexneck::pipeline {

std::vector<multibody::Channel> in_customary_units(std::vector<multibody::Channel> channels,
                                                   const char* moment_unit) {
  const std::vector<std::pair<std::string_view, const char*>> units = {
      {"rad", "deg"},  {"m", "in"},  {"m/s", "in/s"},
      {"m/s^2", "gn"}, {"N", "lbf"}, {"N*m", moment_unit}};
  for (multibody::Channel& channel : channels)
    for (const auto& [si, customary] : units) {
      if (channel.unit != si) continue;
      channel.values *= factor_from_si(si, customary);
      channel.unit = customary;
      break;
    }
  return channels;
}

}  // namespace flexneck::pipeline
