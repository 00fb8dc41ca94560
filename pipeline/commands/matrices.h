// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "mesher/mesh/mesh.h"
#include "pipeline/commands/commands.h"

namespace flexneck::pipeline {

/// `flexneck modes` of a study with [matrices].
/// @pre input.study.matrices
bool modes_of_matrices(const CommandInput& input);

/// Whether `export` writes matrices to a file of that name: NAME.mtx or NAME.petsc.
bool is_matrix_file(const std::filesystem::path& target);

/// Writes K and M without what is held to NAME_K.mtx and NAME_M.mtx, and the positions of the nodes
/// to NAME_nodes.mtx; in PETSc's binary format likewise.
/// @param mesh changed as structure_options() does
void export_matrices(const CommandInput& input, mesher::Mesh& mesh);

}  // namespace flexneck::pipeline
