// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace flexneck::geometry {

/// Remarks on a size or mass that hardly any structure of this tool has, as when millimetres were
/// declared as metres; empty if there is nothing to remark.
/// @param extent_m largest extent of the structure
std::vector<std::string> implausibilities(double extent_m, double mass_kg);

/// A remark on a density that hardly any solid of this stiffness has, as when a weight density was
/// given for a mass density; it says which slip would explain the figure. Empty if there is nothing
/// to remark. Metals are told from plastics, rubbers and foams by Young's modulus and Poisson's
/// ratio: butyl in N/m^3, 9310, would be a usual figure for a metal.
std::string implausible_density(double youngs_modulus_Pa, double poissons_ratio,
                                double density_kg_m3);

}  // namespace flexneck::geometry
