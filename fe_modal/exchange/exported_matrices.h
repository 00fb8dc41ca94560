// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/dofs/dof_map.h"
#include "fe_modal/element/formulation.h"
#include "fe_modal/exchange/imported_body.h"

namespace flexneck::fe_modal {

/// K and M of a mesh for other programs, without what is fixed; of nodes that are tied the first
/// one stands for all.
/// @pre the DofMap is not constrained; springs and masses are at nodes
/// @throws what assemble() throws.
ImportedBody export_matrices(const mesher::Mesh& mesh, const DofMap& dof_map,
                             const FormulationChoice& formulation);

}  // namespace flexneck::fe_modal
