// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/dofs/affine_constraints.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Fixes motions of reference points on which neither couplings, equations, springs nor masses act:
/// the rotation of a point that is not used, or that about the line of its coupled nodes.
/// @throws InputError for such a motion of a point with a mass, as it is unconstrained.
void hold_points(const mesher::Mesh& mesh, const mesher::Connections& connections,
                 AffineConstraints& constraints);

}  // namespace flexneck::fe_modal
