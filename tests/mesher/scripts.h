// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fstream>
#include <string>

#include "geometry/foundation/temporary_folder.h"
#include "mesher/gmsh/script_mesher.h"

namespace flexneck::testing {

/// A gmsh script of one or two hexahedral blocks, with dimensions given by its constants.
inline const char* const kBrick = R"(
DefineConstant[ width = {1, Name "Brick/width"}, cells = {2, Name "cells"}, bare = 3 ];
Point(1) = {0, 0, 0};
Point(2) = {width, 0, 0};
Line(1) = {1, 2};
Transfinite Curve {1} = cells + 1;
f[] = Extrude {0, 2, 0} { Line{1}; Layers{2}; Recombine; };
v[] = Extrude {0, 0, 3} { Surface{f[1]}; Layers{2}; Recombine; };
Physical Volume("brick") = {v[1]};
Physical Surface("skin") = {f[1], v[0], v[2], v[3], v[4], v[5]};
)";

/// Writes a script into a folder of its own and meshes it with one material, "stuff".
class ScriptFixture {
 public:
  explicit ScriptFixture(const std::string& text) {
    options.script = folder_ / "test.geo";
    std::ofstream(options.script) << text;
    options.materials = {
        {.name = "stuff", .youngs_modulus_Pa = 1e6, .poissons_ratio = 0.3, .density_kg_m3 = 1000}};
    options.material_of_part = {{"brick", "stuff"}};
  }

  mesher::Mesh mesh() const { return mesher::mesh_script(options, {}); }

  mesher::ScriptMeshOptions options;

 private:
  TemporaryFolder folder_;
};

}  // namespace flexneck::testing
