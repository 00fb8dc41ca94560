// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/display_units.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/foundation/units.h"

namespace flexneck::pipeline {

using Json = nlohmann::ordered_json;

namespace {

struct Row {
  const char* unit;  ///< unit in a file or a table
  const char* customary;
  const char* metric;
};
constexpr std::array kRows = {
    Row{"m", "in", "mm"},
    Row{"mm", "in", "mm"},
    Row{"in", "in", "mm"},
    Row{"ft", "ft", "m"},
    Row{"rad", "deg", "deg"},
    Row{"deg", "deg", "deg"},
    Row{"s", "ms", "ms"},
    Row{"ms", "ms", "ms"},
    Row{"m/s", "in/s", "m/s"},
    Row{"in/s", "in/s", "m/s"},
    Row{"ft/s", "ft/s", "m/s"},
    Row{"m/s^2", "gn", "gn"},
    Row{"gn", "gn", "gn"},
    Row{"rad/s", "deg/s", "deg/s"},
    Row{"rad/s^2", "deg/s^2", "deg/s^2"},
    Row{"N", "lbf", "kN"},
    Row{"kN", "lbf", "kN"},
    Row{"lbf", "lbf", "kN"},
    Row{"N*m", "lbf*ft", "N*m"},
    Row{"lbf*ft", "lbf*ft", "N*m"},
    Row{"in*lbf", "in*lbf", "N*m"},
    Row{"N/m", "lbf/in", "N/mm"},
    Row{"lbf/in", "lbf/in", "N/mm"},
    Row{"N*m/rad", "in*lbf/deg", "N*m/deg"},
    Row{"in*lbf/deg", "in*lbf/deg", "N*m/deg"},
    Row{"N*m/rad^3", "in*lbf/deg^3", "N*m/deg^3"},
    Row{"N*m*s/rad", "in*lbf*s/deg", "N*m*s/deg"},
    Row{"in*lbf*s/deg", "in*lbf*s/deg", "N*m*s/deg"},
    Row{"lbf*in*s/deg", "lbf*in*s/deg", "N*m*s/deg"},
    Row{"kg", "lb", "kg"},
    Row{"lb", "lb", "kg"},
    Row{"kg*m^2", "lbf*s^2*in", "kg*m^2"},
    Row{"lbf*s^2*in", "lbf*s^2*in", "kg*m^2"},
    Row{"kg/m^3", "lb/in^3", "kg/m^3"},
    Row{"lb/in^3", "lb/in^3", "kg/m^3"},
    Row{"lbf/in^3", "lbf/in^3", "kN/m^3"},
    Row{"Pa", "kpsi", "MPa"},
    Row{"MPa", "kpsi", "MPa"},
    Row{"psi", "psi", "MPa"},
    Row{"kpsi", "kpsi", "MPa"},
    Row{"J", "ft*lbf", "J"},
};

Json shown_as(const std::string& unit, const std::string& shown) {
  return {{"name", unit_label(shown)}, {"factor", unit == shown ? 1 : factor_from_si(unit, shown)}};
}

}  // namespace

std::string unit_label(const std::string& unit) {
  if (unit == "gn") return "g";
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kSigns = {
      {{"*", "·"}, {"^2", "²"}, {"^3", "³"}, {"^4", "⁴"}}};
  std::string label = unit;
  for (const auto& [plain, sign] : kSigns)
    for (std::size_t at = label.find(plain); at != std::string::npos;
         at = label.find(plain, at + sign.size()))
      label.replace(at, plain.size(), sign);
  return label;
}

Json display_unit(const std::string& unit, const std::string& customary) {
  const auto* const row =
      std::find_if(kRows.begin(), kRows.end(), [&](const Row& each) { return each.unit == unit; });
  if (row == kRows.end()) return nullptr;
  return {{"customary", shown_as(unit, customary.empty() ? row->customary : customary)},
          {"metric", shown_as(unit, row->metric)}};
}

Json display_unit(const std::string& unit) { return display_unit(unit, ""); }

Json display_units() {
  Json units = Json::object();
  for (const Row& row : kRows) units[row.unit] = display_unit(row.unit);
  return units;
}

}  // namespace flexneck::pipeline
