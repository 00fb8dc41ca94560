// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "mesher/drawing/raster.h"

namespace flexneck::mesher {

/// The colour map Viridis, as 0xRRGGBB from its lower to its upper end at equal distances:
/// lightness increases evenly, so that colours are ordered also without colour vision and in grey
/// print.
inline constexpr std::array<std::uint32_t, 6> kColourScale = {0x440154, 0x414487, 0x2A788E,
                                                              0x22A884, 0x7AD151, 0xFDE725};

/// A colour interpolated in kColourScale.
/// @param share 0 … 1; values outside are clamped
Colour scale_colour(double share);

/// Colours of parts and materials, which differ in lightness too; they repeat after eight.
Colour category_colour(std::size_t index);

}  // namespace flexneck::mesher
