// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "mesher/mesh/mesh.h"
#include "pipeline/console/console.h"
#include "pipeline/isolation/isolated_task.h"
#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// The mesh that a study asks for. gmsh runs in this process only for the shipped script. Over
/// files from elsewhere it and OpenCASCADE may crash, hang or take all memory, and a user's script
/// is a program, so these are meshed in a child process. The mesh is the same to the last bit.
///  - A finished mesh may take 0.75 GB and 16 times its size, 10 s of the processor and 1 s/MB.
///  - A shape may take 10 s and 10 s/MB until it is read; then it and a script may take any time,
///    since how fine a mesh becomes is the study's choice.
///  - Shapes and scripts may take the memory that is free.
/// What OpenCASCADE complains of, though it makes a shape of it, is a warning.
/// @pre study.structure
/// @throws InputError or ComputationError as the mesher does; InputError if the child dies.
mesher::Mesh make_mesh(const Study& study, const Console& console);

/// The child's part: takes the file to write the mesh to, the study and its settings.
void mesh_task(const std::vector<std::string>& arguments, const ChildLines& lines);

}  // namespace flexneck::pipeline
