// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geometry/neck/neck_parameters.h"

namespace flexneck::geometry {

/// State of the slits: absent, cut but tied shut, or open cracks of zero width.
enum class SlitState { none, closed, open };

/// Slits in rubber sections: plane cuts at mid-height through the front half, from -90 to 90
/// degrees seen from the plate axis. Their inner edge is one of the mesh's circles, between the
/// hole and the rim; an O-grid has no line for a straight edge. The paper reports slits in the
/// centre sections; that they lie in the front, and how deep they are, is inferred.
struct NeckSlits {
  SlitState state = SlitState::none;
  std::vector<std::string> parts = {"rubber_2", "rubber_3"};
  /// Fraction of the rubber between rim and hole that is cut, 0 < depth < 1, exact straight ahead.
  /// Once it is given, the mesh has a circle there in every state: meshes with closed, open and no
  /// slits then differ in nothing else.
  std::optional<double> depth = std::nullopt;
};

/// Checks the slits against the divisions.
/// @throws InputError with the condition that fails: a depth out of range, no or unknown parts, or
/// divisions that have no line where a slit ends (even quadrant, inner_ring of 2 or more) or no
/// mid-height plane (even rubber_layers).
void check(const NeckSlits& slits, const NeckDivisions& divisions);

/// Face sets that the script creates for the slits, "slit_rubber_2" …; none for SlitState::none.
std::vector<std::string> slit_face_sets(const NeckSlits& slits);

/// Values of the script's constants for the slits; empty without a depth.
std::map<std::string, double> script_constants(const NeckSlits& slits);

}  // namespace flexneck::geometry
