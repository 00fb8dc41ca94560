// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

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
  bool is_fixed;  ///< keeps no rigid motion
};

/// Discretisation error of each frequency, by the same modes with every element cut in eight
/// (mesher::refine). The finer modes are those that inverse iteration makes of the coarse ones, so
/// that each keeps its shape, and nothing else is searched for. Richardson extrapolation with the
/// order that singular edges leave at worst, one, and a safety factor of 1.5 for coarse meshes make
/// the estimate three times the change: as frequencies converge with an order p >= 1, that is
/// 3 (1 - 2^-p) times the error, between 1.5 and 3. It sees neither how far the mesh's surface is
/// off the true one nor what the model leaves out.
/// @param options with which the mesh was solved
/// @throws ComputationError if the finer problem does not fit in memory or its modes do not settle.
std::vector<MeshError> mesh_errors(const SolvedMesh& solved, const ModalOptions& options,
                                   const Progress& progress);

}  // namespace flexneck::fe_modal
