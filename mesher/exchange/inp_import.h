// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/foundation/progress.h"
#include "mesher/exchange/import_options.h"
#include "mesher/exchange/left_out.h"

namespace flexneck::mesher {

/// Imports a mesh from an Abaqus or CalculiX input.
///  - Parts: the ELSETs that `material_of_part` names, with its materials; then, for elements in
///    none of them, the ELSETs of *SOLID SECTION with the file's materials. Every element must
///    belong to exactly one.
///  - Units: the file's numbers are consistent. With the length unit L and the force unit F of the
///    options and seconds, E counts in F / L^2 and the density in F s^2 / L^4: with mm and N that
///    is MPa and t/mm^3.
///  - Sets: each NSET is a node set, and a face set where its nodes are those of whole faces of the
///    mesh's surface; each SURFACE is a face set, and a node set if no NSET has its name. Nodes
///    that *BOUNDARY fixes are the node set "boundary".
///  - Names keep the case in which they are first written; the file does not distinguish cases.
/// Nodes without elements, loads and the like are left out: `left_out` gets their number, and that
/// of elements with another integration than this program's (C3D8I, C3D8R; C3D20R unless the
/// options ask for reduced integration).
/// @throws InputError as import_mesh, with the line where there is one.
Mesh import_inp(const ImportOptions& options, const Progress& progress, LeftOut& left_out);

}  // namespace flexneck::mesher
