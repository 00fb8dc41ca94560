// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/laboratory/iso_mme/channel_code.h"

#include <algorithm>
#include <array>

namespace flexneck::pipeline {

using multibody::ChannelClass;

namespace {

/// Filter classes of ISO 6487 and SAE J211 of 1995, then those of earlier editions, which pass the
/// same frequencies. The first of several letters for one text is written.
constexpr std::array<MmeFilter, 18> kFilters = {{
    {'0', ""},
    {'A', "CFC 1000", ChannelClass::cfc1000},
    {'B', "CFC 600", ChannelClass::cfc600},
    {'C', "CFC 180", ChannelClass::cfc180},
    {'D', "CFC 60", ChannelClass::cfc60},
    {'E', "CFC 1000", ChannelClass::cfc1000},
    {'F', "CFC 600", ChannelClass::cfc600},
    {'G', "CFC 180", ChannelClass::cfc180},
    {'H', "CFC 60", ChannelClass::cfc60},
    {'P', "prefiltered above CFC 1000"},
    {'V', "from a film"},
    {'X', "without a filter"},
    {'1', "FIR 100", {}, true},
    {'2', "CFC 600, force CFC 1000", {}, true},
    {'3', "CFC 600 and CFC 180 combined", {}, true},
    {'L', "CFC 20", {}, true},
    {'Q', "prefiltered below CFC 60", {}, true},
    {'S', "special", {}, true},
}};

struct Dimension {
  std::string_view code, si_unit;
};

/// Physical dimensions. The first of several for one unit is written.
constexpr std::array<Dimension, 19> kDimensions = {{
    {"AA", "rad/s^2"}, {"AC", "m/s^2"},  {"AN", "rad"}, {"AV", "rad/s"}, {"DS", "m"},
    {"DC", "m"},       {"DV", "m"},      {"LE", "m"},   {"EN", "J"},     {"FO", "N"},
    {"FR", "Hz"},      {"IM", "kg*m/s"}, {"MA", "kg"},  {"MO", "N*m"},   {"PR", "Pa"},
    {"TI", "s"},       {"VE", "m/s"},    {"VA", "m/s"}, {"VD", "m/s"},
}};

struct UnitName {
  std::string_view mme, ours;
};

/// Names of units. The first of several for one of flexneck's units is written.
constexpr std::array<UnitName, 13> kUnits = {{
    {"Nm", "N*m"},
    {"m/(s*s)", "m/s^2"},
    {"rad/(s*s)", "rad/s^2"},
    {"kNm", "kN*m"},
    {"Nmm", "N*mm"},
    {"deg", "deg"},
    {"deg/s", "deg/s"},
    {"deg/(s*s)", "deg/s^2"},
    {"\u00b0", "deg"},
    {"\u00b0/s", "deg/s"},
    {"\u00b0/s\u00b2", "deg/s^2"},
    {"m/s\u00b2", "m/s^2"},
    {"m/s2", "m/s^2"},
}};

constexpr std::size_t kDimensionPlace = 12;

}  // namespace

bool is_mme_code(std::string_view text) {
  return text.size() == kMmeCodeLength && std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
         });
}

MmeFilter mme_filter(std::string_view code) {
  const auto found = std::find_if(kFilters.begin(), kFilters.end(), [&](const MmeFilter& each) {
    return each.letter == code.back();
  });
  return found != kFilters.end() ? *found : kFilters.back();
}

char mme_filter_letter(std::string_view filter) {
  const auto found = std::find_if(kFilters.begin(), kFilters.end(),
                                  [&](const MmeFilter& each) { return each.text == filter; });
  return found != kFilters.end() ? found->letter : 'S';
}

std::string_view mme_si_unit(std::string_view code) {
  for (const Dimension& each : kDimensions)
    if (each.code == code.substr(kDimensionPlace, 2)) return each.si_unit;
  return {};
}

std::string_view mme_dimension(std::string_view si_unit) {
  for (const Dimension& each : kDimensions)
    if (each.si_unit == si_unit) return each.code;
  return "00";
}

std::string unit_from_mme(const std::string& unit, std::string_view code) {
  // A file's g is gravity for an acceleration, as everywhere; converted here, since a curve's unit
  // is later used without its dimension.
  if ((unit == "g" || unit == "G") && mme_si_unit(code) == "m/s^2") return "gn";
  for (const UnitName& each : kUnits)
    if (each.mme == unit) return std::string(each.ours);
  return unit;
}

std::string unit_to_mme(const std::string& unit) {
  for (const UnitName& each : kUnits)
    if (each.ours == unit) return std::string(each.mme);
  return unit;
}

}  // namespace flexneck::pipeline
