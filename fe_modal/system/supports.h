// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/system/loads.h"
#include "fe_modal/system/modal_options.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// For each node, (n), the directions x, y, z in which supports along these may act on it, or
/// connections may pass on forces; both nodes of a pair that a tied slit couples have the same.
/// Connections are couplings, rigid interfaces, equations, springs and supports in axes of their
/// own.
std::vector<std::array<bool, 3>> reacting_directions_of(const mesher::Mesh& mesh,
                                                        const ModalOptions& options);

/// Displacements of the supports, (3, n) in m: those of the SupportLoads in the fixed directions,
/// zero elsewhere.
/// @throws InputError if a node of such a load is not fixed, if the load moves none of its nodes in
/// a fixed direction, translates one in a free direction, if two loads move a node differently, or
/// if one moves a node on which a connection acts.
Eigen::Matrix3Xd support_displacements(const mesher::Mesh& mesh, const ModalOptions& options,
                                       const std::vector<Load>& loads);

}  // namespace flexneck::fe_modal
