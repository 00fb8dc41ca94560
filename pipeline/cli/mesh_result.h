// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "mesher/mesh/mesh_file.h"
#include "pipeline/cli/commands.h"

namespace flexneck::pipeline {

/// Exact volumes of parts, m^3, where closed forms are known.
using ExactVolumes = std::map<std::string, double>;

/// Text with the size and mass of a mesh, and a table of its parts with their quality.
std::string mesh_text(const mesher::Mesh& mesh, const ExactVolumes& exact, bool with_parts);

/// Completes every mesh command: adds the partitions and the order that the study asks for, writes
/// mesh.h5 and its view, and prints the table of its parts with their quality.
void finish_mesh(const CommandInput& input, mesher::MeshFile file, const ExactVolumes& exact);

}  // namespace flexneck::pipeline
