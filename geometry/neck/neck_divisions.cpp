// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/output_file.h"
#include "geometry/neck/neck_parameters.h"

namespace flexneck::geometry {
namespace {

[[noreturn]] void refuse(const std::string& name, const std::string& expected,
                         const std::string& found) {
  throw InputError("mesh divisions: " + name + " must be " + expected + ", found " + found);
}

}  // namespace

NeckDivisions divisions_preset(const std::string& name) {
  const std::vector<std::pair<std::string, NeckDivisions>> presets = {{"default", {}},
                                                                      {"paper",
                                                                       {.quadrant = 6,
                                                                        .inner_ring = 3,
                                                                        .outer_ring = 2,
                                                                        .rubber_layers = 5,
                                                                        .plate_layers = 2,
                                                                        .end_plate_layers = 1,
                                                                        .ring_grading = 1,
                                                                        .rubber_grading = 1}}};
  std::vector<std::string> names;
  names.reserve(presets.size());
  for (const auto& [known, unused] : presets) names.push_back(known);
  return presets[find_name(names, name, "preset of mesh divisions")].second;
}

double hexahedra(const NeckDivisions& divisions) {
  const double round = 4.0 * divisions.quadrant;
  const double in_plates = (2.0 * divisions.end_plate_layers + 3.0 * divisions.plate_layers) *
                           (1.0 * divisions.inner_ring + divisions.outer_ring);
  const double in_rubber = 4.0 * divisions.rubber_layers * divisions.inner_ring;
  const double cuts = divisions.refine + 1.0;
  return round * (in_plates + in_rubber) * cuts * cuts * cuts;
}

void check(const NeckDivisions& divisions) {
  const std::array<std::pair<const char*, int>, 6> counts = {{
      {"quadrant", divisions.quadrant},
      {"inner_ring", divisions.inner_ring},
      {"outer_ring", divisions.outer_ring},
      {"rubber_layers", divisions.rubber_layers},
      {"plate_layers", divisions.plate_layers},
      {"end_plate_layers", divisions.end_plate_layers},
  }};
  for (const auto& [name, count] : counts) {
    if (count < 1) refuse(name, "1 or more", std::to_string(count));
  }
  if (divisions.refine < 0) refuse("refine", "0 or more", std::to_string(divisions.refine));
  const std::array<std::pair<const char*, double>, 2> gradings = {
      {{"ring_grading", divisions.ring_grading}, {"rubber_grading", divisions.rubber_grading}}};
  for (const auto& [name, grading] : gradings) {
    if (!(std::isfinite(grading) && grading > 0)) refuse(name, "> 0", rounded_text(grading));
  }
}

}  // namespace flexneck::geometry
