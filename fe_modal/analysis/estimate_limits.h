// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "fe_modal/system/loads.h"
#include "fe_modal/system/modal_options.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Names the sets that are held or joined at single nodes, a line for each, "node set 'bolts' (4 of
/// its 8 nodes)": nodes of supports and couplings that are neither on a whole face of such nodes
/// nor in an element beside one, and all nodes of equations, springs and masses. Under a force on a
/// point an elastic body gives way without limit, so that frequencies and displacements have none
/// either as the elements become smaller.
std::vector<std::string> held_at_single_nodes(const mesher::Mesh& mesh,
                                              const ModalOptions& options);

/// The same of the nodes that loads of a static step act on: "load 'pull' (1 node)".
std::vector<std::string> loaded_at_single_nodes(const mesher::Mesh& mesh,
                                                const std::vector<Load>& loads);

/// Why estimates of the mesh's error (discretisation_error.h) are an indication alone: the single
/// nodes that hold the body, or load it for a prestress. Empty if there are none. Nothing else
/// makes them one: at edges that are re-entrant, bonded, held or cracked stresses grow without
/// limit, too, but frequencies converge with an order of at least 1/2, of which the estimate is
/// 0.88 of the error.
std::string limits_of_estimate(const mesher::Mesh& mesh, const ModalOptions& options);

}  // namespace flexneck::fe_modal
