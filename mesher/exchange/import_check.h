// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// Checks typical errors of imported meshes, beyond check(): overlapping copies (elements on the
/// same nodes; nodes at the same position, unless `keeps_doubles`), pieces that share no node, and
/// elements that are inverted or degenerate. Positions are the same within 1e-9 of the mesh's size.
/// @throws InputError saying how many there are, and where the first is.
void check_import(const Mesh& mesh, bool keeps_doubles);

}  // namespace flexneck::mesher
