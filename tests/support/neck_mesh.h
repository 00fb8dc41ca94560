// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "geometry/foundation/units.h"
#include "geometry/neck_parameters.h"
#include "mesher/script_mesher.h"

/// The four sets of neck dimensions that were fitted to the published frequencies, as fixtures.
/// Users of this header link flexneck::geometry and flexneck::mesher.
namespace flexneck::test {

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
  constexpr double kInch = 0.0254;
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

inline std::vector<mesher::Material> neck_materials() {
  return {{.name = "aluminium",
           .youngs_modulus_Pa = parse_quantity("10000 kpsi", "Pa"),
           .poissons_ratio = 0.33,
           .density_kg_m3 = parse_quantity("0.0981 lb/in^3", "kg/m^3")},
          {.name = "butyl",
           .youngs_modulus_Pa = parse_quantity("1.2 kpsi", "Pa"),
           .poissons_ratio = 0.49,
           .density_kg_m3 = parse_quantity("0.0343 lb/in^3", "kg/m^3")}};
}

inline mesher::ScriptMeshOptions neck_mesh_options(const geometry::NeckParameters& neck,
                                                   const geometry::NeckDivisions& divisions = {}) {
  mesher::ScriptMeshOptions options;
  options.script = FLEXNECK_SOURCE_DIR "/geometry/neck.geo";
  options.constants = geometry::script_constants(neck, divisions);
  options.materials = neck_materials();
  for (const char* plate : {"base_plate", "plate_1", "plate_2", "plate_3", "top_plate"}) {
    options.material_of_part[plate] = "aluminium";
  }
  for (const char* rubber : {"rubber_1", "rubber_2", "rubber_3", "rubber_4"}) {
    options.material_of_part[rubber] = "butyl";
  }
  const auto centres = geometry::bolt_centres(neck);
  options.patches = {{.name = "bolts",
                      .face_set = "base",
                      .centres_m = {centres.begin(), centres.end()},
                      .radius_m = neck.bolt_patch_radius}};
  return options;
}

/// Mesh with the parts base_plate, rubber_1, plate_1, …, top_plate, the face and node sets "base"
/// and "top", and the node set "bolts".
inline mesher::Mesh neck_mesh(const std::string& set,
                              const geometry::NeckDivisions& divisions = {}) {
  return mesher::mesh_script(neck_mesh_options(neck_parameters(set), divisions), {});
}

}  // namespace flexneck::test
