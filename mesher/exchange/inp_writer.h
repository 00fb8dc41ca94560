// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// A *STATIC step before the *FREQUENCY step.
struct InpStaticStep {
  std::vector<std::array<double, 3>> forces_N;         ///< (n), for *CLOAD
  std::vector<std::array<double, 3>> displacements_m;  ///< (n), of fixed nodes, for *BOUNDARY
  bool prestresses_modes = false;                      ///< *FREQUENCY is a PERTURBATION of it
};

struct InpOptions {
  std::set<std::string> reduced;   ///< materials written as C3D20R instead of C3D20
  std::vector<std::string> fixed;  ///< node sets for *BOUNDARY
  std::map<std::string, std::array<bool, 3>> fixed_directions = {};  ///< more sets, by directions
  int mode_count = 10;  ///< number of modes for *FREQUENCY
  std::optional<InpStaticStep> static_step = std::nullopt;
};

/// Writes a deck in SI units that CalculiX solves for the modes and Abaqus reads: *NODE, *ELEMENT
/// by part, *NSET, *SURFACE, *MATERIAL, *SOLID SECTION, *BOUNDARY, a step with *STATIC if there are
/// loads, and one with *FREQUENCY; the node pairs of tied slits as *EQUATION; of the connections
/// only supports along x, y and z. Numbers have at most 20 characters, which is all that CalculiX
/// reads: at least 13 digits.
/// @throws InputError if the file cannot be written, an element kind has no type there (hex27,
/// prism18), the mesh has other connections, or a name is invalid there: it must consist of
/// letters, digits, "_", "-" and ".", begin with a letter and differ from others in capitals.
void write_inp(const std::filesystem::path& file, const Mesh& mesh, const InpOptions& options);

}  // namespace flexneck::mesher
