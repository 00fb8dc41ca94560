// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "multibody/analysis/linearisation.h"

namespace flexneck::multibody {

/// Small motions about steady rotation at several rates, each mode followed from one to the next.
struct CampbellDiagram {
  std::vector<double> rates_rad_s;
  /// modes[k][r] is mode k at rate r. Modes are in the order of their frequencies at the first
  /// rate; frequencies are those seen from the bodies that turn.
  std::vector<std::vector<SystemMode>> modes;
};

/// The prescribed bodies that turn at time zero are given each of the rates, about their axis in
/// the direction in which they turn. A mode is the one of the next rate whose shape is most like
/// its own (modal assurance criterion with the masses); among like shapes, whose frequency is
/// nearest.
/// @param rates_rad_s  not negative, ascending
/// @throws InputError, ComputationError as rotating_positions(); InputError if no prescribed body
/// turns.
CampbellDiagram campbell_diagram(const Model& model, const std::vector<double>& rates_rad_s);

}  // namespace flexneck::multibody
