// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace flexneck::geometry {

/// Remarks on an unusual size or mass of a structure, as when millimetres were declared as metres;
/// empty if there is nothing to remark.
/// @param extent_m largest extent of the structure
std::vector<std::string> implausibilities(double extent_m, double mass_kg);

/// A remark on an unusual density of a solid of this stiffness, as when a weight density was given
/// for a mass density; it says which mistake would explain it. Empty if there is nothing to remark.
/// Young's modulus and Poisson's ratio distinguish metals from plastics, rubbers and foams: butyl
/// in N/m^3, 9310, would be a usual value for a metal.
std::string implausible_density(double youngs_modulus_Pa, double poissons_ratio,
                                double density_kg_m3);

}  // namespace flexneck::geometry
