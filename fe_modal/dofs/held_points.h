// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/dofs/affine_constraints.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Motions of reference points that neither couplings, equations, springs nor masses feel become
/// zero: a point's rotation that nobody uses, or that about the line of its coupled nodes.
/// @throws InputError for such a motion of a point with a mass: nothing holds it.
void hold_points(const mesher::Mesh& mesh, const mesher::Connections& connections,
                 AffineConstraints& constraints);

}  // namespace flexneck::fe_modal
