// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

#include "geometry/neck/neck_parameters.h"

/// The four sets of neck dimensions that were fitted to the published frequencies, as fixtures:
/// written out here a second time, so that tests do not depend on the parameter files.
namespace flexneck::testing {

inline constexpr double kInch = 0.0254;

/// The dimensions in which the sets differ, in inches.
struct FittedDimensions {
  double base_plate, plate, top_plate;
  double bottom_diameter, bottom_offset, top_diameter, top_offset;
};

/// `set` is "A", "B", "C" or "C'".
inline FittedDimensions fitted_dimensions(const std::string& set) {
  if (set == "A") return {.74, .385, 1.25, 2.55, .2, 2.55, .2};
  if (set == "B") return {.674, .83, .27, 2.22, .36, 2.22, .36};
  if (set == "C") return {1.357, .326, .306, 2.038, .351, 2.266, .40};
  if (set == "C'") return {.97, .49, .16, 2.13, .15, 2.13, .15};
  throw std::invalid_argument("no neck set '" + set + "'");
}

inline geometry::NeckParameters neck_parameters(const std::string& set) {
  const FittedDimensions d = fitted_dimensions(set);
  return {.length = 5.66 * kInch,
          .base_plate_thickness = d.base_plate * kInch,
          .plate_thickness = d.plate * kInch,
          .top_plate_thickness = d.top_plate * kInch,
          .plate_diameter = 3.4 * kInch,
          .hole_diameter = 0.625 * kInch,
          .centre_rubber_diameter = 2.7 * kInch,
          .centre_rubber_offset = 0.2 * kInch,
          .bottom_rubber_diameter = d.bottom_diameter * kInch,
          .bottom_rubber_offset = d.bottom_offset * kInch,
          .top_rubber_diameter = d.top_diameter * kInch,
          .top_rubber_offset = d.top_offset * kInch,
          .bolt_circle_radius = 1.25 * kInch,
          .bolt_patch_radius = 0.13 * kInch};
}

}  // namespace flexneck::testing
