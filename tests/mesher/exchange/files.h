// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "mesher/gmsh/mesh_import.h"

namespace flexneck::testing {

/// Files in a folder of their own.
class Files {
 public:
  std::filesystem::path write(const std::string& name, const std::string& contents) const {
    std::ofstream(folder_ / name, std::ios::binary) << contents;
    return folder_ / name;
  }
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

 private:
  TemporaryFolder folder_;
};

/// Message with which an import refuses, or "accepted".
inline std::string refusal(const mesher::ImportOptions& options) {
  try {
    mesher::import_mesh(options, {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

/// The warnings of an import, one per line.
inline std::string warnings_of(const mesher::ImportOptions& options) {
  std::string lines;
  mesher::import_mesh(options, {}, [&](const std::string& line) { lines += line + "\n"; });
  return lines;
}

/// Import options in which all named parts have one material, "stuff".
inline mesher::ImportOptions import_options(const std::filesystem::path& file,
                                            const std::vector<std::string>& parts) {
  mesher::ImportOptions options;
  options.file = file;
  options.materials = {
      {.name = "stuff", .youngs_modulus_Pa = 1e6, .poissons_ratio = 0.3, .density_kg_m3 = 1000}};
  for (const std::string& part : parts) options.material_of_part[part] = "stuff";
  return options;
}

/// A tetrahedron with straight edges of 1 in .msh 2.2, of the part "corner".
inline const char* const kTetrahedronMsh = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
1
3 7 "corner"
$EndPhysicalNames
$Nodes
10
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
5 0.5 0 0
6 0.5 0.5 0
7 0 0.5 0
8 0 0 0.5
9 0 0.5 0.5
10 0.5 0 0.5
$EndNodes
$Elements
1
1 11 2 7 1 1 2 3 4 5 6 7 8 9 10
$EndElements
)";

/// The warning of an import of an Abaqus deck.
/// @param is_reduced  true if the modes will use elements with reduced integration
inline std::string warning_of_deck(const std::string& deck, bool is_reduced = false) {
  const Files files;
  mesher::ImportOptions options;
  options.file = files.write("deck.inp", deck);
  options.is_reduced = is_reduced;
  return warnings_of(options);
}

}  // namespace flexneck::testing
