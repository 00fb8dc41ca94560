// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "multibody/analysis/linearisation.h"

namespace flexneck::multibody {

/// Small motions about steady rotation at several rates, each mode followed from one rate to the
/// next.
struct CampbellDiagram {
  std::vector<double> rates_rad_s;
  /// modes[k][r] is mode k at rate r. Modes are in the order of their frequencies at the first
  /// rate; frequencies are those in the rotating frame.
  std::vector<std::vector<SystemMode>> modes;
};

/// Computes the modes while the prescribed bodies that rotate at time zero have each of the rates,
/// about their axis and in their direction of rotation. A mode is followed to the one at the next
/// rate with the most similar shape (modal assurance criterion in the mass metric); among similar
/// shapes, to that of the nearest frequency.
/// @param rates_rad_s  not negative, ascending
/// @throws InputError, ComputationError as rotating_positions(); InputError if no prescribed body
/// rotates.
CampbellDiagram campbell_diagram(const Model& model, const std::vector<double>& rates_rad_s);

}  // namespace flexneck::multibody
