// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/system/modal_options.h"

namespace flexneck::fe_modal {

/// Estimate of the bytes that an analysis takes, from measurements of necks from 12 000 to 190 000
/// degrees of freedom, of 27-node and 20-node hexahedra: within a fifth of them. Factors grow
/// faster than meshes, and depend on the shape of the body: that of a slender one takes a fraction
/// of the estimate.
struct MemoryNeeds {
  double assembling = 0;  ///< mesh, matrices and modes, without the factor
  double peak = 0;        ///< with the factor
};
MemoryNeeds memory_needs(double dofs, int mode_count);

/// Refuses an analysis that certainly takes too much memory, before assembly; factors are checked
/// when their order of elimination is known.
/// @throws InputError with the required and the available memory and the remedy.
void check_memory(const mesher::Mesh& mesh, const ModalOptions& options);

}  // namespace flexneck::fe_modal
