// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pipeline/process/isolated_task.h"

namespace flexneck::pipeline {

/// Task of the program flexneck-mesher: meshes studies by gmsh.
/// @param arguments  arguments of a MeshOrder
/// @throws ComputationError as the mesher does; InputError if a study cannot be read.
void mesh_task(const std::vector<std::string>& arguments, const ChildLines& lines);

}  // namespace flexneck::pipeline
