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

/// Why estimates of the mesh's error (discretisation_error.h) are an indication alone: what is held
/// at single nodes, and elements longer than those of the bodies for which the estimate was
/// compared with the error. Empty if it was shown for such bodies.
std::string limits_of_estimate(const mesher::Mesh& mesh, const ModalOptions& options);

}  // namespace flexneck::fe_modal
