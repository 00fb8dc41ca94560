// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geometry/foundation/progress.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// Nodes of a face set within `radius_m` of one of the centres become a node set.
struct NodePatches {
  std::string name;
  std::string face_set;
  std::vector<std::array<double, 3>> centres_m;
  double radius_m = 0;
};

/// A gmsh script and the use of its physical groups: each physical volume is a part, each physical
/// surface a face set and a node set of the same name.
struct ScriptMeshOptions {
  std::filesystem::path script;
  /// Values that override those of the script's DefineConstant. A constant needs the attribute Name
  /// there; it is known by the part of that name after the last '/'.
  std::map<std::string, double> constants;
  double length_unit_m = 1;  ///< unit of length of the script and its constants
  std::vector<Material> materials;
  std::map<std::string, std::string> material_of_part;  ///< material name by part, every part once
  /// Required kind of the elements: hex27, hex20, hex8 or tet10. A script without recombination
  /// gives tetrahedra whatever is asked for, so it has to agree. If empty: complete second order,
  /// of the shapes that the script gives.
  std::optional<ElementKind> element;
  std::vector<std::string> slits;  ///< face sets to cut the mesh along, as in slits.h
  bool slits_tied = false;
  std::vector<NodePatches> patches;  ///< applied after the cuts: both nodes of a pair are within
                                     ///< the radius
};

/// Runs the script in gmsh, meshes the geometry and imports the mesh, with lengths in m. A script
/// is a program: it may do whatever gmsh scripts may do. With constants to override it runs twice,
/// first to find which it declares.
/// @param warn  gets the failures after which gmsh went on
/// @throws InputError if the script cannot be read, has an error (gmsh's message), sets a scaling
/// factor that gmsh applies to files only, sets a constant that it does not declare, names a part
/// without material, has elements of a kind that a mesh cannot hold or none of the kind asked for,
/// leaves a set empty, or cannot be slit as asked.
/// @throws ComputationError if an element is inverted or degenerate.
Mesh mesh_script(const ScriptMeshOptions& options, const Progress& progress,
                 const Progress& warn = {});

}  // namespace flexneck::mesher
