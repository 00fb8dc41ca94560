// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/plausibility.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/foundation/output_file.h"
#include "geometry/foundation/units.h"

namespace flexneck::geometry {
namespace {

// The ranges span a small joint to a large vehicle. A length wrong by a factor of 1000 leaves the
// range for everything between 2 cm and 5 m, and the mass with it.
constexpr double kSmallestExtent_m = 0.005;
constexpr double kLargestExtent_m = 20;
constexpr double kSmallestMass_kg = 1e-4;
constexpr double kLargestMass_kg = 1e5;

std::string remark(const char* what, double value, const char* unit, bool is_large) {
  return std::string(what) + " is " + rounded_text(value, 4) + " " + unit + "; were " +
         (is_large ? "millimetres or inches declared as metres?"
                   : "metres declared as millimetres?");
}

/// Range of densities of solids of similar stiffness.
struct DensityRange {
  double modulus_Pa;  ///< lower bound of Young's modulus of the row
  double low_kg_m3, usual_kg_m3, high_kg_m3;
  const char* solids;
};

/// Solids, stiffest first. The ranges are high enough for tungsten, lead and filled rubber, low
/// enough for fibre composites, wood and foam; g times the usual density is outside each range but
/// that of foams.
constexpr std::array<DensityRange, 5> kSolids = {{
    {100e9, 1400, 7850, 23000, "metals and composites"},
    {40e9, 1400, 2700, 11000, "light metals, glass and composites"},
    {12e9, 300, 2000, 12000, "concrete, bone, wood and lead"},
    {1e9, 60, 1200, 3500, "plastics and wood"},
    {0, 5, 200, 3000, "foams and soft tissue"},
}};
constexpr DensityRange kRubbers = {0, 600, 1000, 3000, "rubbers and gels"};
/// Bound above which a soft solid is a rubber: foams are compressible.
constexpr double kRubberPoissonsRatio = 0.45;

const DensityRange& range_of(double youngs_modulus_Pa, double poissons_ratio) {
  const auto* const row = std::find_if(kSolids.begin(), kSolids.end() - 1, [&](const auto& solid) {
    return youngs_modulus_Pa >= solid.modulus_Pa;
  });
  return row->modulus_Pa == 0 && poissons_ratio > kRubberPoissonsRatio ? kRubbers : *row;
}

/// A mistake of units that multiplies the density by the factor.
struct Slip {
  double factor;
  const char* what;
};

/// Known mistakes. In a deck whose unit of length is L a weight density is g / L times too high.
constexpr std::array<Slip, 6> kSlips = {{
    {kStandardGravity_m_s2, "a weight density in N/m^3"},
    {kStandardGravity_m_s2 / 0.0254, "a weight density in lbf/in^3 for lbf s^2/in^4"},
    {kStandardGravity_m_s2 / 0.3048, "a weight density in lbf/ft^3 for lbf s^2/ft^4"},
    {kStandardGravity_m_s2 / 0.001, "a weight density in N/mm^3 for t/mm^3"},
    {1000, "a density in kg/mm^3 for t/mm^3"},
    {0.001, "a density in g/cm^3 for kg/m^3"},
}};

/// The mistake whose correction brings the density closest to the usual one; null if none explains
/// it.
const Slip* slip_of(const DensityRange& range, double density_kg_m3) {
  const auto distance = [&](const Slip& slip) {
    return std::abs(std::log(density_kg_m3 / slip.factor / range.usual_kg_m3));
  };
  const auto* const nearest =
      std::min_element(kSlips.begin(), kSlips.end(),
                       [&](const Slip& a, const Slip& b) { return distance(a) < distance(b); });
  const double meant = density_kg_m3 / nearest->factor;
  return meant >= range.low_kg_m3 && meant <= range.high_kg_m3 ? nearest : nullptr;
}

}  // namespace

std::vector<std::string> implausibilities(double extent_m, double mass_kg) {
  std::vector<std::string> remarks;
  if (!(extent_m >= kSmallestExtent_m && extent_m <= kLargestExtent_m)) {
    remarks.push_back(remark("the largest extent", extent_m, "m", extent_m > kLargestExtent_m));
  }
  if (!(mass_kg >= kSmallestMass_kg && mass_kg <= kLargestMass_kg)) {
    remarks.push_back(remark("the mass", mass_kg, "kg", mass_kg > kLargestMass_kg));
  }
  return remarks;
}

std::string implausible_density(double youngs_modulus_Pa, double poissons_ratio,
                                double density_kg_m3) {
  const DensityRange& range = range_of(youngs_modulus_Pa, poissons_ratio);
  if (density_kg_m3 >= range.low_kg_m3 && density_kg_m3 <= range.high_kg_m3) return {};
  std::string remark = "the density is " + rounded_text(density_kg_m3, 4) + " kg/m^3, but " +
                       range.solids + " with a modulus near " + rounded_text(youngs_modulus_Pa, 2) +
                       " Pa have " + rounded_text(range.low_kg_m3) + " to " +
                       rounded_text(range.high_kg_m3);
  if (const Slip* const slip = slip_of(range, density_kg_m3)) {
    remark += std::string("; was it given as ") + slip->what + "? Then it would be " +
              rounded_text(density_kg_m3 / slip->factor, 4) + " kg/m^3";
  }
  return remark;
}

}  // namespace flexneck::geometry
