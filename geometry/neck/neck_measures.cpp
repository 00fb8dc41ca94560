// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/neck/neck_measures.h"

#include <numbers>

#include "geometry/foundation/error.h"

namespace flexneck::geometry {
namespace {

/// Mass and its moments about the origin: int dm, x dm, z dm, x^2, y^2, z^2 and x z dm.
struct Moments {
  double volume = 0, m = 0, x = 0, z = 0, xx = 0, yy = 0, zz = 0, xz = 0;

  void add(const Moments& other, double factor) {
    volume += factor * other.volume;
    m += factor * other.m;
    x += factor * other.x;
    z += factor * other.z;
    xx += factor * other.xx;
    yy += factor * other.yy;
    zz += factor * other.zz;
    xz += factor * other.xz;
  }
};

/// Moments of a solid upright cylinder whose axis passes through (offset, 0).
Moments cylinder(double density, double diameter, double offset, double bottom, double height) {
  Moments c;
  c.volume = std::numbers::pi / 4 * diameter * diameter * height;
  c.m = density * c.volume;
  const double middle = bottom + height / 2;
  c.x = c.m * offset;
  c.z = c.m * middle;
  c.yy = c.m * diameter * diameter / 16;
  c.xx = c.yy + c.m * offset * offset;
  c.zz = c.m * (height * height / 12 + middle * middle);
  c.xz = c.m * offset * middle;
  return c;
}

}  // namespace

NeckMeasures measure(const NeckParameters& neck,
                     const std::map<std::string, double>& density_kg_m3) {
  NeckMeasures result;
  Moments sum;
  for (const NeckLayer& layer : layers_of(neck)) {
    const auto density = density_kg_m3.find(layer.part);
    if (density == density_kg_m3.end()) {
      throw InputError("part '" + layer.part +
                       "' has no material; add it to the parts of a material");
    }
    Moments part = cylinder(density->second, layer.diameter_m, layer.offset_m, layer.bottom_m,
                            layer.thickness_m);
    part.add(cylinder(density->second, neck.hole_diameter, 0, layer.bottom_m, layer.thickness_m),
             -1);
    result.parts.push_back({layer.part, part.volume, part.m});
    sum.add(part, 1);
  }
  result.volume_m3 = sum.volume;
  result.mass_kg = sum.m;
  result.centre_m = {sum.x / sum.m, 0, sum.z / sum.m};
  const double xx = sum.xx - sum.x * sum.x / sum.m;
  const double zz = sum.zz - sum.z * sum.z / sum.m;
  result.inertia_kg_m2 = {sum.yy + zz, xx + zz, xx + sum.yy};
  result.product_xz_kg_m2 = sum.xz - sum.x * sum.z / sum.m;
  return result;
}

}  // namespace flexneck::geometry
