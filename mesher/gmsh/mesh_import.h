// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/foundation/progress.h"
#include "mesher/exchange/import_options.h"

namespace flexneck::mesher {

/// Reads a mesh, or a shape, which is meshed with 10-node tetrahedra. The parts are
///  - the physical volumes of a .msh; without groups "volume_<tag>" of the entity;
///  - those of an .inp, .bdf or .unv: see inp_import.h, nastran_import.h and unv_import.h;
///  - the volumes of a shape by their label, or "volume_<tag>"; where they touch they are glued.
/// Sets come from physical surfaces, curves and points, and from the faces of a shape as
/// "surface_<tag>".
/// @throws InputError if the file is not of the format of its ending, has elements that a mesh
/// cannot hold (which, how many), inverted, doubled or unconnected ones (import_check.h), parts
/// without material, or a material or box set without anything to apply to.
/// @param warn as in checked_import()
Mesh import_mesh(const ImportOptions& options, const Progress& progress, const Progress& warn = {});

}  // namespace flexneck::mesher
