// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "fe_modal/algebra/eigen_pairs.h"
#include "fe_modal/body/modal_body.h"
#include "fe_modal/solve/assembled_system.h"
#include "geometry/foundation/progress.h"

namespace flexneck::fe_modal {

/// Estimates the discretisation error of each frequency from the modes of a finer mesh, found by
/// the same solver: c |f / f' - 1|.
///
/// Quadratic elements are cut in eight (mesher::refine). Richardson extrapolation with the order
/// that singular edges leave at worst, one, and a safety factor of 1.5 for coarse meshes make c =
/// 3: if frequencies converge with an order p the estimate is 3 (1 - 2^-p) times the error. Linear
/// elements become quadratic ones (mesher::raise_order), with c = 1.5, and all are cut in eight as
/// well if all nodes of some part lie on the body's surface. The estimate does not include the
/// distance of the mesh's surface from the true one, nor the idealisations of the model.
/// @param pairs the modes of the system, rigid motions first
/// @throws OutOfMemory if memory does not hold the factor of the finer mesh.
/// @throws InputError if it does not hold the finer mesh itself.
std::vector<MeshError> mesh_errors(const AssembledSystem& system, const EigenPairs& pairs,
                                   const Progress& progress);

}  // namespace flexneck::fe_modal
