// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesher/mesh/mesh.h"
#include "pipeline/language/study/study.h"
#include "pipeline/process/console.h"

namespace flexneck::pipeline {

/// Makes the mesh that a study asks for. Decks in .inp are read in this process, by flexneck's own
/// reader. All else needs gmsh and its OpenCASCADE, which may crash, hang or use up all memory on
/// foreign files, and a script is a program: the program flexneck-mesher meshes it (mesh_task.h),
/// with limits, so that the command does not load gmsh's libraries.
///  - A finished mesh may take 0.75 GB and 16 times its size, 10 s of the processor and 1 s/MB.
///  - A shape may take 10 s and 10 s/MB until it is read; then it and a script may take any time,
///    since the study chooses how fine a mesh becomes.
///  - Shapes and scripts may take the memory that is free.
/// Complaints of OpenCASCADE about a shape that it can read are warnings.
/// @pre study.structure
/// @throws InputError or ComputationError as the mesher does; InputError if the child dies.
mesher::Mesh make_mesh(const Study& study, const Console& console);

/// The mesh of a study, or the reason why the file or the script gives none.
struct MeshOutcome {
  std::optional<mesher::Mesh> mesh;
  std::string refusal;  ///< empty if there is a mesh
};

/// Makes the meshes of studies that differ in values of one structure, all with one start of the
/// program.
/// @throws ComputationError or InputError as make_mesh(), except if a study's file or script is
/// refused.
std::vector<MeshOutcome> make_meshes(const std::vector<const Study*>& studies,
                                     const Console& console);

}  // namespace flexneck::pipeline
