// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesher/exchange/foreign_file.h"
#include "mesher/exchange/import_options.h"
#include "mesher/exchange/left_out.h"

namespace flexneck::mesher {

/// Lets gmsh read a checked mesh, or mesh a checked shape. Lengths in m. Content of a mesh other
/// than its solids is added to `left_out`.
/// @throws InputError if gmsh cannot read or mesh it, or as import_gmsh_mesh.
Mesh import_with_gmsh(const CheckedCopy& copy, const ImportOptions& options, LeftOut& left_out);

}  // namespace flexneck::mesher
