// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numeric>

#include "mesher/mesh/mesh.h"

namespace flexneck::testing {

/// Two hexahedra of 1 x 1 x 1 m on top of each other as the parts "upper" and "lower", in that
/// order, of the materials "soft" and "hard"; the node and face set "floor".
inline mesher::Mesh small_mesh() {
  using mesher::ElementKind;
  mesher::Mesh mesh;
  mesh.materials = {
      {.name = "soft", .youngs_modulus_Pa = 8e6, .poissons_ratio = 0.49, .density_kg_m3 = 950},
      {.name = "hard", .youngs_modulus_Pa = 7e10, .poissons_ratio = 0.33, .density_kg_m3 = 2700}};
  // Nodes on a grid of 3 x 3 x 5 half metres, x running fastest.
  for (int k = 0; k < 5; ++k) {
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) mesh.nodes.push_back({i / 2.0, j / 2.0, k / 2.0});
    }
  }
  const auto element = [](int level) {
    std::vector<std::int32_t> nodes;
    for (const auto& xi : mesher::reference_nodes(ElementKind::hex27)) {
      const auto step = [&](std::size_t axis) { return static_cast<std::int32_t>(xi[axis]) + 1; };
      nodes.push_back(step(0) + 3 * step(1) + 9 * (step(2) + 2 * level));
    }
    return nodes;
  };
  mesh.blocks = {{.part = "upper", .kind = ElementKind::hex27, .material = 0, .nodes = element(1)},
                 {.part = "lower", .kind = ElementKind::hex27, .material = 1, .nodes = element(0)}};
  mesh.node_sets = {{.name = "floor", .nodes = std::vector<std::int32_t>(9)}};
  std::iota(mesh.node_sets[0].nodes.begin(), mesh.node_sets[0].nodes.end(), 0);
  // Seen from below: xi runs along y, eta along x.
  mesh.face_sets = {
      {.name = "floor",
       .blocks = {{.kind = ElementKind::quad9, .nodes = {0, 6, 8, 2, 3, 7, 5, 1, 4}}}}};
  return mesh;
}

}  // namespace flexneck::testing
