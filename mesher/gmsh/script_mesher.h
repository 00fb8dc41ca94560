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

/// A gmsh script and what is made of its physical groups: each physical volume is a part, each
/// physical surface a face set and a node set of the same name.
struct ScriptMeshOptions {
  std::filesystem::path script;
  /// Override the script's DefineConstant values. A constant needs the attribute Name there; it is
  /// known by what stands behind the last '/' of that name.
  std::map<std::string, double> constants;
  double length_unit_m = 1;  ///< what the number 1 in the script means, its constants included
  std::vector<Material> materials;
  std::map<std::string, std::string> material_of_part;  ///< part to material name, every part once
  /// What the elements shall be: hex27, hex20, hex8 or tet10. A script without recombination gives
  /// tetrahedra whatever is asked for, so it has to agree. Without a wish: complete second order,
  /// of the shapes that the script gives.
  std::optional<ElementKind> element;
  std::vector<std::string> slits;  ///< face sets to cut the mesh along, as in slits.h
  bool slits_tied = false;
  std::vector<NodePatches> patches;  ///< taken after the cuts: both nodes of a pair are near
};

/// Runs the script in gmsh, meshes it and takes the mesh over, with lengths in m.
/// A script is a program: it may do what gmsh scripts may do. With constants to override it runs
/// twice, first to tell which it declares.
/// @param warn  is told what gmsh failed to do and went on
/// @throws InputError if the script cannot be read, has an error (gmsh's message), sets a scaling
/// factor that gmsh applies to files only, sets a constant that it does not declare, names a part
/// without material, has elements of a kind that a mesh cannot hold or none of the kind asked for,
/// leaves a set empty, or cannot be slit as asked.
/// @throws ComputationError if an element is inverted or degenerate.
Mesh mesh_script(const ScriptMeshOptions& options, const Progress& progress,
                 const Progress& warn = {});

}  // namespace flexneck::mesher
