// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/system/modal_options.h"

namespace flexneck::fe_modal {

/// Bytes that an analysis takes, estimated before it starts, by measurements of necks from 12 000
/// to 190 000 degrees of freedom, of 27-node and 20-node hexahedra: within a fifth of them. Factors
/// grow faster than meshes, and with the shape of the body: that of a slender one takes a fraction
/// of what is estimated.
struct MemoryNeeds {
  double assembling = 0;  ///< mesh, matrices and modes: what is taken whatever the factor takes
  double peak = 0;        ///< with the factor
};
MemoryNeeds memory_needs(double dofs, int mode_count);

/// What is known to be too much before anything is assembled; factors are refused when their order
/// of elimination is known. @throws InputError with what it takes, what there is and what to do.
void check_memory(const mesher::Mesh& mesh, const ModalOptions& options);

}  // namespace flexneck::fe_modal
