// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesher/drawing/raster.h"

namespace flexneck::mesher {

/// From dark blue over green to yellow: ordered also without colour vision and in grey print.
/// @param share 0 … 1; values outside are taken to the nearest end
Colour scale_colour(double share);

/// Colours of parts and materials that differ in lightness too; they repeat after eight.
Colour category_colour(std::size_t index);

}  // namespace flexneck::mesher
