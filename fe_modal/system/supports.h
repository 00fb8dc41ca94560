// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/system/loads.h"
#include "fe_modal/system/modal_options.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// For each node the directions x, y, z in which it is fixed, (n); a node that a tied slit couples
/// to a fixed one is fixed like it.
std::vector<std::array<bool, 3>> fixed_directions_of(const mesher::Mesh& mesh,
                                                     const ModalOptions& options);

/// Displacements of the supports, (3, n) in m: those of the SupportLoads in the directions that are
/// fixed, zero elsewhere.
/// @throws InputError if a node of such a load is not fixed, if the load moves none of its nodes in
/// a direction that is fixed, translates one in a direction that is free, or if two loads move a
/// node differently.
Eigen::Matrix3Xd support_displacements(const mesher::Mesh& mesh, const ModalOptions& options,
                                       const std::vector<Load>& loads);

}  // namespace flexneck::fe_modal
