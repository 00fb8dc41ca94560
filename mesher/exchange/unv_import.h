// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/foundation/progress.h"
#include "mesher/exchange/import_options.h"
#include "mesher/exchange/left_out.h"

namespace flexneck::mesher {

/// Imports a mesh from an I-deas universal file.
///  - Parts are the groups of solids that `material_of_part` names; if it names none, the solids of
///    a material, "volume_<number>".
///  - Each group with shells is a face set, one with nodes a node set; shells in no group are the
///    face set "surface_<material>". Groups of the same name are merged.
/// @throws InputError as import_mesh and read_unv(); for solids in no part or in two, and for
/// groups with undefined elements and nodes.
Mesh import_unv(const ImportOptions& options, const Progress& progress, LeftOut& left_out);

}  // namespace flexneck::mesher
