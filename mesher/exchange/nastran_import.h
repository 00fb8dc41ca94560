// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/foundation/progress.h"
#include "mesher/exchange/import_options.h"
#include "mesher/exchange/left_out.h"

namespace flexneck::mesher {

/// Imports a mesh from Nastran's bulk data.
///  - Parts are the solids of a property, "volume_<property>"; shells of a property are the faces
///    of the set "surface_<property>", without stiffness.
///  - Connections are those of nastran_connections.h.
/// Left out and reported are loads, damping, nodes without elements, cards of sets that are not
/// selected, and PARAM,WTMASS, with which densities are weights. Other cards that change the
/// structure, among them shells with a PSHELL, are added by LeftOut::add_to_structure().
/// @throws InputError as import_mesh, with the line: nodes in coordinate systems of their own,
/// INCLUDE, replicated cards, tabs in fixed fields, solids without some of their midside nodes.
Mesh import_nastran(const ImportOptions& options, const Progress& progress, LeftOut& left_out);

}  // namespace flexneck::mesher
