// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

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
  /// Kinds of cards or elements that change the structure and are not supported: to go without.
  std::vector<std::string> leave_out;
  std::vector<BoxSet> box_sets;
  /// Called once a shape is read, before it is meshed, with about the number of nodes that its mesh
  /// will have; may be empty.
  std::function<void(double nodes)> when_read = {};
};

}  // namespace flexneck::mesher
