// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace flexneck::geometry {

/// Remarks on a size or mass that hardly any structure of this tool has, as when millimetres were
/// declared as metres; empty if there is nothing to remark.
/// @param extent_m largest extent of the structure
std::vector<std::string> implausibilities(double extent_m, double mass_kg);

}  // namespace flexneck::geometry
