// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// A block of the mesh: a part, or its elements of one kind.
struct PartSummary {
  std::string part;
  ElementKind kind = ElementKind::hex27;
  std::string material;
  std::size_t elements = 0;
  double volume_m3 = 0;
  double mass_kg = 0;
  double smallest_scaled_jacobian = 0;  ///< as in mesh_measures.h
  double max_aspect_ratio = 0;          ///< as in mesh_measures.h
};

struct MeshSummary {
  std::vector<PartSummary> parts;  ///< in the order of the mesh's blocks
  std::size_t elements = 0;
  std::size_t nodes = 0;
  std::size_t degrees_of_freedom = 0;  ///< three per node, before any is fixed
  double volume_m3 = 0;
  double mass_kg = 0;
  double smallest_scaled_jacobian = 0;
};

/// @pre check(mesh) passes.
MeshSummary summarise(const Mesh& mesh);

}  // namespace flexneck::mesher
