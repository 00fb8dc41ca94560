// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/neck_parameters.h"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/units.h"

namespace flexneck::geometry {
namespace {

std::string in_inches(double length_m) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g in", length_m * factor_from_si("m", "in"));
  return text.data();
}

[[noreturn]] void refuse(const std::string& problem) {
  throw InputError("neck geometry: " + problem);
}

struct NamedLength {
  const char* name;
  double value_m;
  bool may_be_zero;
};

void check_range(const NamedLength& length) {
  const bool ok = std::isfinite(length.value_m) &&
                  (length.value_m > 0 || (length.may_be_zero && length.value_m == 0));
  if (!ok) {
    refuse(std::string(length.name) + (length.may_be_zero ? " must be 0 or more" : " must be > 0") +
           ", found " + in_inches(length.value_m));
  }
}

void check_ranges(const NeckParameters& neck) {
  const std::array lengths = {
      NamedLength{"length", neck.length, false},
      NamedLength{"base_plate_thickness", neck.base_plate_thickness, false},
      NamedLength{"plate_thickness", neck.plate_thickness, false},
      NamedLength{"top_plate_thickness", neck.top_plate_thickness, false},
      NamedLength{"plate_diameter", neck.plate_diameter, false},
      NamedLength{"hole_diameter", neck.hole_diameter, false},
      NamedLength{"centre_rubber_diameter", neck.centre_rubber_diameter, false},
      NamedLength{"centre_rubber_offset", neck.centre_rubber_offset, true},
      NamedLength{"bottom_rubber_diameter", neck.bottom_rubber_diameter, false},
      NamedLength{"bottom_rubber_offset", neck.bottom_rubber_offset, true},
      NamedLength{"top_rubber_diameter", neck.top_rubber_diameter, false},
      NamedLength{"top_rubber_offset", neck.top_rubber_offset, true},
      NamedLength{"bolt_circle_radius", neck.bolt_circle_radius, false},
      NamedLength{"bolt_patch_radius", neck.bolt_patch_radius, false},
  };
  for (const NamedLength& length : lengths) check_range(length);
}

void check_height(const NeckParameters& neck) {
  if (rubber_height(neck) > 0) return;
  refuse(
      "the plates leave no height for the rubber: base_plate_thickness + 3 plate_thickness + " +
      std::string("top_plate_thickness = ") +
      in_inches(neck.base_plate_thickness + 3 * neck.plate_thickness + neck.top_plate_thickness) +
      " must be less than length = " + in_inches(neck.length));
}

/// The hole lies inside the shifted circle, and that inside the plate.
void check_rubber(const NeckParameters& neck, const std::string& section, double diameter,
                  double offset) {
  const double inner_m = neck.hole_diameter / 2 + offset;
  const double rim_m = diameter / 2 + offset;
  if (!(inner_m < diameter / 2)) {
    refuse("the hole leaves the " + section + " rubber: hole_diameter / 2 + " + section +
           "_rubber_offset = " + in_inches(inner_m) + " must be less than " + section +
           "_rubber_diameter / 2 = " + in_inches(diameter / 2));
  }
  if (!(rim_m < neck.plate_diameter / 2)) {
    refuse("the " + section + " rubber leaves the plates: " + section + "_rubber_diameter / 2 + " +
           section + "_rubber_offset = " + in_inches(rim_m) +
           " must be less than plate_diameter / 2 = " + in_inches(neck.plate_diameter / 2));
  }
}

void check_bolts(const NeckParameters& neck) {
  const double outer_m = neck.bolt_circle_radius + neck.bolt_patch_radius;
  const double inner_m = neck.bolt_circle_radius - neck.bolt_patch_radius;
  if (!(outer_m <= neck.plate_diameter / 2)) {
    refuse("the bolts leave the base plate: bolt_circle_radius + bolt_patch_radius = " +
           in_inches(outer_m) +
           " must not exceed plate_diameter / 2 = " + in_inches(neck.plate_diameter / 2));
  }
  if (!(inner_m >= neck.hole_diameter / 2)) {
    refuse("the bolts reach into the hole: bolt_circle_radius - bolt_patch_radius = " +
           in_inches(inner_m) +
           " must not be less than hole_diameter / 2 = " + in_inches(neck.hole_diameter / 2));
  }
}

}  // namespace

double rubber_height(const NeckParameters& neck) {
  return (neck.length - neck.base_plate_thickness - 3 * neck.plate_thickness -
          neck.top_plate_thickness) /
         4;
}

std::array<std::array<double, 3>, 4> bolt_centres(const NeckParameters& neck) {
  const double a = neck.bolt_circle_radius / std::numbers::sqrt2;
  return {{{a, a, 0}, {-a, a, 0}, {-a, -a, 0}, {a, -a, 0}}};
}

void check(const NeckParameters& neck) {
  check_ranges(neck);
  check_height(neck);
  check_rubber(neck, "centre", neck.centre_rubber_diameter, neck.centre_rubber_offset);
  check_rubber(neck, "bottom", neck.bottom_rubber_diameter, neck.bottom_rubber_offset);
  check_rubber(neck, "top", neck.top_rubber_diameter, neck.top_rubber_offset);
  check_bolts(neck);
}

void check(const NeckDivisions& divisions) {
  const std::array<std::pair<const char*, int>, 6> counts = {{
      {"quadrant", divisions.quadrant},
      {"inner_ring", divisions.inner_ring},
      {"outer_ring", divisions.outer_ring},
      {"rubber_layers", divisions.rubber_layers},
      {"plate_layers", divisions.plate_layers},
      {"end_plate_layers", divisions.end_plate_layers},
  }};
  for (const auto& [name, count] : counts) {
    if (count < 1) {
      throw InputError(std::string("mesh divisions: ") + name + " must be 1 or more, found " +
                       std::to_string(count));
    }
  }
  const std::array<std::pair<const char*, double>, 2> gradings = {
      {{"ring_grading", divisions.ring_grading}, {"rubber_grading", divisions.rubber_grading}}};
  for (const auto& [name, grading] : gradings) {
    if (!(std::isfinite(grading) && grading > 0)) {
      throw InputError(std::string("mesh divisions: ") + name + " must be > 0, found " +
                       std::to_string(grading));
    }
  }
}

std::map<std::string, double> script_constants(const NeckParameters& neck,
                                               const NeckDivisions& divisions) {
  return {
      {"length", neck.length},
      {"base_plate_thickness", neck.base_plate_thickness},
      {"plate_thickness", neck.plate_thickness},
      {"top_plate_thickness", neck.top_plate_thickness},
      {"plate_diameter", neck.plate_diameter},
      {"hole_diameter", neck.hole_diameter},
      {"centre_rubber_diameter", neck.centre_rubber_diameter},
      {"centre_rubber_offset", neck.centre_rubber_offset},
      {"bottom_rubber_diameter", neck.bottom_rubber_diameter},
      {"bottom_rubber_offset", neck.bottom_rubber_offset},
      {"top_rubber_diameter", neck.top_rubber_diameter},
      {"top_rubber_offset", neck.top_rubber_offset},
      {"quadrant", divisions.quadrant},
      {"inner_ring", divisions.inner_ring},
      {"outer_ring", divisions.outer_ring},
      {"rubber_layers", divisions.rubber_layers},
      {"plate_layers", divisions.plate_layers},
      {"end_plate_layers", divisions.end_plate_layers},
      {"ring_grading", divisions.ring_grading},
      {"rubber_grading", divisions.rubber_grading},
  };
}

}  // namespace flexneck::geometry
