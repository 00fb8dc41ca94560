// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "fe_modal/algebra/shift_inverse.h"
#include "fe_modal/body/modal_body.h"
#include "fe_modal/solve/assembled_system.h"
#include "fe_modal/solve/eigensolver.h"
#include "fe_modal/system/modal_options.h"
#include "geometry/foundation/progress.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// The modes of one mesh, as far as their error asks.
struct SolvedMesh {
  const mesher::Mesh& mesh;
  const AssembledSystem& system;
  const EigenPairs& pairs;
  const ShiftInverse& inverse;  ///< with which they were found
  Eigen::Index rigid_count;     ///< of the pairs, its first, that are rigid motions
};

/// Discretisation error of each frequency, by the same modes with every element cut in eight
/// (mesher::refine). The finer modes are those that an iteration makes of the coarse ones
/// (refined_modes.h), so that each keeps its shape, and nothing else is searched for; what the
/// iteration leaves out, at most a third of the change, is estimated and taken as a part of it
/// where that makes it larger. Richardson extrapolation with the
/// order that singular edges leave at worst, one, and a safety factor of 1.5 for coarse meshes make
/// the estimate three times the change: as frequencies converge with an order p >= 1, that is
/// 3 (1 - 2^-p) times the error, between 1.5 and 3. It sees neither how far the mesh's surface is
/// off the true one nor what the model leaves out.
/// @param options with which the mesh was solved
/// @throws ComputationError if the finer modes do not settle.
std::vector<MeshError> mesh_errors(const SolvedMesh& solved, const ModalOptions& options,
                                   const Progress& progress);

}  // namespace flexneck::fe_modal
