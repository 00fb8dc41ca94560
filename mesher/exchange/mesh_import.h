// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "geometry/foundation/progress.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// All faces of the mesh's surface whose nodes lie in a box become a face set and a node set.
struct BoxSet {
  std::string name;
  std::array<double, 3> low_m{};
  std::array<double, 3> high_m{};
};

/// A geometry or mesh that the user brings, and what is made of it.
struct ImportOptions {
  std::filesystem::path file;  ///< its ending says what it is, see foreign_file.h
  double length_unit_m = 1;    ///< what the number 1 in the file means; a STEP file knows it itself
  double force_unit_N = 1;  ///< the same for materials, springs and masses of .inp, .bdf; time: s
  std::vector<Material> materials;  ///< in SI units
  /// Part to material name. What an .inp says of the materials of other parts holds; in every other
  /// file each part needs a material here.
  std::map<std::string, std::string> material_of_part;
  double element_size_m = 0;   ///< of STEP and BREP shapes; 0: gmsh's choice
  bool is_reduced = false;     ///< modes will be of reduced integration, as C3D20R of an .inp are
  bool keeps_doubles = false;  ///< nodes in the same place are meant, as at a crack
  std::vector<BoxSet> box_sets;
  /// Called once a shape is read, before it is meshed, with about the number of nodes that its mesh
  /// will have; may be empty.
  std::function<void(double nodes)> when_read = {};
};

/// Reads the file; a shape is meshed with 10-node tetrahedra. The parts are
///  - the physical volumes of a .msh, the groups of a .unv; without groups (.bdf: without names)
///    "volume_<tag>", the tag being that of the entity or property;
///  - the ELSETs of an .inp, see inp_import.h;
///  - the volumes of a shape by their label, or "volume_<tag>"; where they touch they are glued.
/// Sets come from physical surfaces, curves and points, from NSETs and SURFACEs, and from the faces
/// of a shape as "surface_<tag>".
/// @throws InputError if the file is not what its ending says, has elements that a mesh cannot hold
/// (which, how many), inverted, doubled or unconnected ones (import_check.h), parts without
/// material, or a material or box set without anything to apply to; a .bdf as survey_nastran, and a
/// .bdf or .unv of which gmsh misses elements.
/// @param warn gets one line if the file has more than a mesh can hold, such as masses, springs,
/// supports and loads: all of it by kind and number
Mesh import_mesh(const ImportOptions& options, const Progress& progress, const Progress& warn = {});

}  // namespace flexneck::mesher
