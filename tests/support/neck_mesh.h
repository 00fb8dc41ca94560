// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "geometry/foundation/units.h"
#include "mesher/gmsh/script_mesher.h"
#include "tests/support/neck_parameters.h"

/// Meshes of the four fitted necks. Users of this header link flexneck::geometry and
/// flexneck::mesher.
namespace flexneck::testing {

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

}  // namespace flexneck::testing
