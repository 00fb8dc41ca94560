// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "geometry/neck/neck_parameters.h"

namespace flexneck::geometry {

struct PartMeasure {
  std::string part;
  double volume_m3 = 0;
  double mass_kg = 0;
};

/// The neck as a rigid body, from closed forms: cylinders with a hole. Frame of NeckParameters; the
/// neck is symmetric to its x-z plane.
struct NeckMeasures {
  std::vector<PartMeasure> parts;  ///< from below
  double volume_m3 = 0;
  double mass_kg = 0;
  std::array<double, 3> centre_m{};  ///< centre of gravity
  /// Moments of inertia about the centre of gravity, along x, y, z: int (y^2 + z^2) dm and so on.
  std::array<double, 3> inertia_kg_m2{};
  double product_xz_kg_m2 = 0;  ///< int x z dm about the centre of gravity; the other products
                                ///< vanish
};

/// Computes the measures.
/// @param density_kg_m3 density of each part
/// @throws InputError if a part has none.
NeckMeasures measure(const NeckParameters& neck,
                     const std::map<std::string, double>& density_kg_m3);

}  // namespace flexneck::geometry
