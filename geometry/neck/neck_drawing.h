// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "geometry/neck/neck_slits.h"

namespace flexneck::geometry {

/// Draws the section through the plane of symmetry in characters: front to the right, to scale as
/// far as characters twice as high as wide allow, at most 80 columns wide. Plates are '#', rubber
/// is ':', a slit '-' (open) or '=' (tied). Each layer has its name and thickness beside it.
/// @pre check(neck) passes.
std::string drawn_section(const NeckParameters& neck, const NeckSlits& slits);

}  // namespace flexneck::geometry
