// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/body/modal_body.h"

namespace flexneck::fe_modal {

/// Checks the invariants of every modal body, whatever its origin: the identities among its inertia
/// invariants, and
///   Names of modes are unique and kinds known. Frequencies ascend, below any that a solid can
///   have; those of kind "rigid", and no others, are zero. Rigid modes are rigid motions: in their
///   shapes, at the interfaces, in S2 and in N0. Compliances, response masses, geometric
///   stiffnesses and mass matrices of attached bodies are symmetric, the first two and the last
///   positive; the modes' part of a compliance does not exceed it.
/// Sums are checked to their rounding, results of solutions of linear systems to 1e-6.
/// @pre the shapes of all arrays agree
/// @throws InputError "<dataset>: …" with the entry, its error, and the allowed error.
void check_modal_body(const ModalBody& body);

}  // namespace flexneck::fe_modal
