// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/neck/neck_parameters.h"

#include <cmath>
#include <numbers>
#include <string_view>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "geometry/foundation/units.h"

namespace flexneck::geometry {
namespace {

std::string in_inches(double length_m) {
  return rounded_text(length_m * factor_from_si("m", "in"), 4) + " in";
}

[[noreturn]] void refuse(const std::string& problem) {
  throw InputError("neck geometry: " + problem);
}

constexpr std::array<NeckDimension, 14> kDimensions = {{
    {"length", &NeckParameters::length, false, "height of the neck, end plates included"},
    {"base_plate_thickness", &NeckParameters::base_plate_thickness, false,
     "thickness of the base plate"},
    {"plate_thickness", &NeckParameters::plate_thickness, false,
     "thickness of each of the three intermediate plates"},
    {"top_plate_thickness", &NeckParameters::top_plate_thickness, false,
     "thickness of the top plate"},
    {"plate_diameter", &NeckParameters::plate_diameter, false, "diameter of all five plates"},
    {"hole_diameter", &NeckParameters::hole_diameter, false,
     "diameter of the central hole for the cable"},
    {"centre_rubber_diameter", &NeckParameters::centre_rubber_diameter, false,
     "diameter of rubber sections 2 and 3"},
    {"centre_rubber_offset", &NeckParameters::centre_rubber_offset, true,
     "forward offset of the axis of rubber sections 2 and 3"},
    {"bottom_rubber_diameter", &NeckParameters::bottom_rubber_diameter, false,
     "diameter of rubber section 1"},
    {"bottom_rubber_offset", &NeckParameters::bottom_rubber_offset, true,
     "forward offset of the axis of rubber section 1"},
    {"top_rubber_diameter", &NeckParameters::top_rubber_diameter, false,
     "diameter of rubber section 4"},
    {"top_rubber_offset", &NeckParameters::top_rubber_offset, true,
     "forward offset of the axis of rubber section 4"},
    {"bolt_circle_radius", &NeckParameters::bolt_circle_radius, false,
     "radius of the circle of bolts, which are at 45, 135, 225 and 315 deg"},
    {"bolt_patch_radius", &NeckParameters::bolt_patch_radius, false,
     "radius around each bolt within which nodes of the base face are fixed"},
}};

void check_range(const NeckDimension& dimension, double value_m) {
  const bool ok =
      std::isfinite(value_m) && (value_m > 0 || (dimension.may_be_zero && value_m == 0));
  if (!ok) {
    refuse(std::string(dimension.name) +
           (dimension.may_be_zero ? " must be 0 or more" : " must be > 0") + ", found " +
           in_inches(value_m));
  }
}

void check_height(const NeckParameters& neck) {
  if (rubber_height(neck) > 0) return;
  refuse(
      "no height remains for the rubber: base_plate_thickness + 3 plate_thickness + " +
      std::string("top_plate_thickness = ") +
      in_inches(neck.base_plate_thickness + 3 * neck.plate_thickness + neck.top_plate_thickness) +
      " must be less than length = " + in_inches(neck.length));
}

/// Checks that the hole lies inside the shifted circle, and that circle inside the plate.
void check_rubber(const NeckParameters& neck, const std::string& section, double diameter,
                  double offset) {
  const double inner_m = neck.hole_diameter / 2 + offset;
  const double rim_m = diameter / 2 + offset;
  if (!(inner_m < diameter / 2)) {
    refuse("the hole extends beyond the " + section + " rubber: hole_diameter / 2 + " + section +
           "_rubber_offset = " + in_inches(inner_m) + " must be less than " + section +
           "_rubber_diameter / 2 = " + in_inches(diameter / 2));
  }
  if (!(rim_m < neck.plate_diameter / 2)) {
    refuse("the " + section + " rubber extends beyond the plates: " + section +
           "_rubber_diameter / 2 + " + section + "_rubber_offset = " + in_inches(rim_m) +
           " must be less than plate_diameter / 2 = " + in_inches(neck.plate_diameter / 2));
  }
}

void check_bolts(const NeckParameters& neck) {
  const double outer_m = neck.bolt_circle_radius + neck.bolt_patch_radius;
  const double inner_m = neck.bolt_circle_radius - neck.bolt_patch_radius;
  if (!(outer_m <= neck.plate_diameter / 2)) {
    refuse("the bolts extend beyond the base plate: bolt_circle_radius + bolt_patch_radius = " +
           in_inches(outer_m) +
           " must not exceed plate_diameter / 2 = " + in_inches(neck.plate_diameter / 2));
  }
  if (!(inner_m >= neck.hole_diameter / 2)) {
    refuse("the bolts extend into the hole: bolt_circle_radius - bolt_patch_radius = " +
           in_inches(inner_m) +
           " must not be less than hole_diameter / 2 = " + in_inches(neck.hole_diameter / 2));
  }
}

}  // namespace

std::span<const NeckDimension> neck_dimensions() { return kDimensions; }

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
  for (const NeckDimension& dimension : kDimensions) check_range(dimension, neck.*dimension.member);
  check_height(neck);
  check_rubber(neck, "centre", neck.centre_rubber_diameter, neck.centre_rubber_offset);
  check_rubber(neck, "bottom", neck.bottom_rubber_diameter, neck.bottom_rubber_offset);
  check_rubber(neck, "top", neck.top_rubber_diameter, neck.top_rubber_offset);
  check_bolts(neck);
}

std::map<std::string, double> script_constants(const NeckParameters& neck,
                                               const NeckDivisions& divisions) {
  std::map<std::string, double> constants = {
      {"quadrant", divisions.quadrant},         {"inner_ring", divisions.inner_ring},
      {"outer_ring", divisions.outer_ring},     {"rubber_layers", divisions.rubber_layers},
      {"plate_layers", divisions.plate_layers}, {"end_plate_layers", divisions.end_plate_layers},
      {"ring_grading", divisions.ring_grading}, {"rubber_grading", divisions.rubber_grading},
  };
  if (divisions.refine > 0) constants["refine"] = divisions.refine + 1;
  for (const NeckDimension& dimension : kDimensions) {
    // Bolts are selected in the mesh; the script has no constants for them.
    if (std::string_view(dimension.name).starts_with("bolt")) continue;
    constants[dimension.name] = neck.*dimension.member;
  }
  return constants;
}

std::vector<NeckLayer> layers_of(const NeckParameters& neck) {
  const double h = rubber_height(neck);
  std::vector<NeckLayer> layers;
  double z = 0;
  const auto add = [&](const std::string& part, double thickness, double diameter, double offset,
                       bool is_rubber) {
    layers.push_back({part, z, thickness, diameter, offset, is_rubber});
    z += thickness;
  };
  const auto plate = [&](const std::string& part, double thickness) {
    add(part, thickness, neck.plate_diameter, 0, false);
  };
  const auto centre_rubber = [&](const std::string& part) {
    add(part, h, neck.centre_rubber_diameter, neck.centre_rubber_offset, true);
  };
  plate("base_plate", neck.base_plate_thickness);
  add("rubber_1", h, neck.bottom_rubber_diameter, neck.bottom_rubber_offset, true);
  plate("plate_1", neck.plate_thickness);
  centre_rubber("rubber_2");
  plate("plate_2", neck.plate_thickness);
  centre_rubber("rubber_3");
  plate("plate_3", neck.plate_thickness);
  add("rubber_4", h, neck.top_rubber_diameter, neck.top_rubber_offset, true);
  plate("top_plate", neck.top_plate_thickness);
  return layers;
}

}  // namespace flexneck::geometry
