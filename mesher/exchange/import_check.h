// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// Checks what goes wrong in meshes that come from elsewhere, beyond check(): overlapping copies
/// (elements on the same nodes; nodes in the same place, unless `keeps_doubles`), pieces that share
/// no node, and elements that are inverted or degenerate.
/// Nodes count as in the same place within 1e-9 of the mesh's size.
/// @throws InputError saying how many there are, and where the first is.
void check_import(const Mesh& mesh, bool keeps_doubles);

}  // namespace flexneck::mesher
