// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "fe_modal/system/loads.h"
#include "fe_modal/system/modal_options.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Names the sets that are constrained or joined at single nodes, a line for each, "node set
/// 'bolts' (4 of its 8 nodes)": nodes of supports and couplings that are neither on a whole face of
/// such nodes nor in an element beside one, and all nodes of equations, springs and masses. A force
/// at a point displaces an elastic body without limit, so that frequencies and displacements do not
/// converge as the elements become smaller.
std::vector<std::string> held_at_single_nodes(const mesher::Mesh& mesh,
                                              const ModalOptions& options);

/// Names the loads of a static step that act on single nodes, in the same way: "load 'pull' (1
/// node)".
std::vector<std::string> loaded_at_single_nodes(const mesher::Mesh& mesh,
                                                const std::vector<Load>& loads);

/// Reason why estimates of the discretisation error (discretisation_error.h) are only an
/// indication: single nodes that support the body, or load it for a prestress. Empty if there are
/// none. There is no other reason: at re-entrant, bonded, clamped or cracked edges stresses grow
/// without limit, too, but frequencies converge with an order of at least 1/2, at which the
/// estimate is 0.88 of the error.
std::string limits_of_estimate(const mesher::Mesh& mesh, const ModalOptions& options);

}  // namespace flexneck::fe_modal
