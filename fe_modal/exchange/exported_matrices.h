// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/dofs/dof_map.h"
#include "fe_modal/element/formulation.h"
#include "fe_modal/exchange/imported_body.h"

namespace flexneck::fe_modal {

/// Assembles K and M of a mesh for other programs, without fixed nodes; the first of nodes that are
/// tied represents all.
/// @pre the DofMap is not constrained; springs and masses are at nodes
/// @throws as assemble().
ImportedBody export_matrices(const mesher::Mesh& mesh, const DofMap& dof_map,
                             const FormulationChoice& formulation);

}  // namespace flexneck::fe_modal
