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

/// A geometry or mesh file of the user, and the options of its import.
struct ImportOptions {
  std::filesystem::path file;       ///< its ending gives the format, see foreign_file.h
  double length_unit_m = 1;         ///< unit of length of the file; ignored for STEP
  double force_unit_N = 1;          ///< unit of force of .inp, .bdf; the unit of time is s
  std::vector<Material> materials;  ///< in SI units
  /// Material name by part. Other parts of an .inp keep the file's materials; in every other file
  /// each part needs a material here.
  std::map<std::string, std::string> material_of_part;
  double element_size_m = 0;   ///< element size of STEP and BREP shapes; 0 for gmsh's choice
  bool is_reduced = false;     ///< modes will use reduced integration, as C3D20R of an .inp
  bool keeps_doubles = false;  ///< nodes at the same position are intended, as at a crack
  /// Kinds of unsupported cards or elements that change the structure and that the user agrees to
  /// leave out.
  std::vector<std::string> leave_out;
  std::vector<BoxSet> box_sets;
  /// Called when a shape has been read, before it is meshed, with the estimated number of nodes of
  /// its mesh; may be empty.
  std::function<void(double nodes)> when_read = {};
};

}  // namespace flexneck::mesher
