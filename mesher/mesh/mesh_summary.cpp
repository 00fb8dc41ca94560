// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mesh/mesh_summary.h"

#include <algorithm>
#include <limits>

#include "mesher/mesh/mesh_measures.h"

namespace flexneck::mesher {

MeshSummary summarise(const Mesh& mesh) {
  MeshSummary summary;
  summary.nodes = mesh.nodes.size();
  summary.degrees_of_freedom = 3 * mesh.nodes.size();
  summary.smallest_scaled_jacobian = std::numeric_limits<double>::infinity();
  for (const ElementBlock& block : mesh.blocks) {
    const Material& material = mesh.materials[block.material];
    const BlockMeasure measured = measure(mesh, block);
    summary.parts.push_back({.part = block.part,
                             .kind = block.kind,
                             .material = material.name,
                             .elements = block.size(),
                             .volume_m3 = measured.volume_m3,
                             .mass_kg = measured.volume_m3 * material.density_kg_m3,
                             .smallest_scaled_jacobian = measured.smallest_scaled_jacobian,
                             .max_aspect_ratio = measured.max_aspect_ratio});
    const PartSummary& part = summary.parts.back();
    summary.elements += part.elements;
    summary.volume_m3 += part.volume_m3;
    summary.mass_kg += part.mass_kg;
    summary.smallest_scaled_jacobian =
        std::min(summary.smallest_scaled_jacobian, part.smallest_scaled_jacobian);
  }
  return summary;
}

}  // namespace flexneck::mesher
