// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace flexneck::testing {

/// Arguments for the coarsest neck, which takes one second instead of ten.
inline constexpr const char* kCoarseNeck =
    " --set mesh.quadrant=2 --set mesh.inner_ring=2 --set mesh.outer_ring=1"
    " --set mesh.rubber_layers=1 --set geometry.bolt_patch_radius='0.4 in'";

}  // namespace flexneck::testing
