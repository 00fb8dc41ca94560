// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/plausibility.h"

#include <array>
#include <cstdio>

namespace flexneck::geometry {
namespace {

// From a small joint to a large vehicle. A length off by a factor of 1000 leaves the range for
// everything between 2 cm and 5 m, and the mass with it.
constexpr double kSmallestExtent_m = 0.005;
constexpr double kLargestExtent_m = 20;
constexpr double kSmallestMass_kg = 1e-4;
constexpr double kLargestMass_kg = 1e5;

std::string remark(const char* what, double value, const char* unit, bool is_large) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "%s is %.4g %s; were %s declared as %s?", what, value,
                unit, is_large ? "millimetres or inches" : "metres",
                is_large ? "metres" : "millimetres");
  return text.data();
}

}  // namespace

std::vector<std::string> implausibilities(double extent_m, double mass_kg) {
  std::vector<std::string> remarks;
  if (!(extent_m >= kSmallestExtent_m && extent_m <= kLargestExtent_m)) {
    remarks.push_back(remark("the largest extent", extent_m, "m", extent_m > kLargestExtent_m));
  }
  if (!(mass_kg >= kSmallestMass_kg && mass_kg <= kLargestMass_kg)) {
    remarks.push_back(remark("the mass", mass_kg, "kg", mass_kg > kLargestMass_kg));
  }
  return remarks;
}

}  // namespace flexneck::geometry
