// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesher/mesh/mesh_file.h"
#include "pipeline/cli/commands.h"

namespace flexneck::pipeline {

/// Solves the linear static step under the study's [[load]]; writes stress.h5 and stress.xdmf and
/// prints its figures.
/// @pre a fe_modal::PetscSession
/// @throws as fe_modal::analyse_static() does.
void write_stresses(const CommandInput& input, mesher::MeshFile mesh);

}  // namespace flexneck::pipeline
