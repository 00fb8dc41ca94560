// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/neck/neck_slits.h"

#include <algorithm>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::geometry {
namespace {

[[noreturn]] void refuse(const std::string& problem) {
  throw InputError("neck geometry: " + problem);
}

void check_depth(const NeckSlits& slits) {
  if (slits.state != SlitState::none && !slits.depth) {
    refuse("slits need slit_depth, the fraction of the rubber between rim and hole that is cut: " +
           std::string("0 < slit_depth < 1; the paper does not report it"));
  }
  if (slits.depth && !(*slits.depth > 0 && *slits.depth < 1)) {
    refuse("slits must end between rim and hole: 0 < slit_depth < 1, found " +
           rounded_text(*slits.depth));
  }
}

void check_parts(const NeckSlits& slits) {
  if (slits.parts.empty()) refuse("expected at least one rubber section in slit_parts, found none");
  check_names(slits.parts, "slit part");
  for (const std::string& part : slits.parts) {
    find_name({"rubber_1", "rubber_2", "rubber_3", "rubber_4"}, part, "rubber section");
  }
}

}  // namespace

void check(const NeckSlits& slits, const NeckDivisions& divisions) {
  check_depth(slits);
  if (!slits.depth) return;
  check_parts(slits);
  if (divisions.quadrant % 2 != 0) {
    refuse(
        "slits end at -90 and 90 deg, where the mesh has a line only if quadrant is even; found "
        "quadrant = " +
        std::to_string(divisions.quadrant));
  }
  if (divisions.inner_ring < 2) {
    refuse(
        "slits end on a circle of the mesh between hole and rim, which needs inner_ring >= 2; "
        "found " +
        std::to_string(divisions.inner_ring));
  }
  if (slits.state != SlitState::none && divisions.rubber_layers % 2 != 0) {
    refuse(
        "slits lie at mid-height, where the mesh has a plane only if rubber_layers is even; found "
        "rubber_layers = " +
        std::to_string(divisions.rubber_layers));
  }
}

std::vector<std::string> slit_face_sets(const NeckSlits& slits) {
  std::vector<std::string> names;
  if (slits.state == SlitState::none) return names;
  for (const std::string& part : slits.parts) names.push_back("slit_" + part);
  std::sort(names.begin(), names.end());
  return names;
}

std::map<std::string, double> script_constants(const NeckSlits& slits) {
  std::map<std::string, double> constants;
  if (!slits.depth) return constants;
  constants["slit_depth"] = *slits.depth;
  for (const std::string& face_set : slit_face_sets(slits)) constants[face_set] = 1;
  return constants;
}

}  // namespace flexneck::geometry
