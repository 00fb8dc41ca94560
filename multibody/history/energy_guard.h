// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "multibody/model/model.h"
#include "multibody/model/motion_state.h"
#include "multibody/numerics/error_estimate.h"

namespace flexneck::multibody {

/// What a run has seen of its energies: with it, it is taken up again.
struct EnergyBooks {
  bool are_open = false;
  double first_balance_J = 0, first_gravitational_J = 0, first_dissipated_J = 0, first_work_J = 0;
  double largest_J = 0;     ///< kinetic, stored or dissipated energy or work, so far
  double departs_at_s = 0;  ///< where the balance first was off by more than is told
  double worst = 0;         ///< by how much it was off, of the largest
};

/// Watches the balance of energy of a run in time,
///   kinetic + gravitational + strain + dissipated - work,
/// which must stay what it was. It is told where it changes by more than 1e-3 of the largest energy
/// so far, and ends the run above 1e-1: a motion whose energy is wrong is wrong.
class EnergyGuard {
 public:
  EnergyGuard(const Model& model, Tolerance tolerance);

  /// Behind each accepted step, and before the first.
  /// @throws ComputationError: when and by how much.
  void check(double time_s, const Energies& stored, double dissipated_J, double work_J);
  /// A sentence if there is something to tell.
  std::vector<std::string> warnings() const;

  const EnergyBooks& books() const { return books_; }
  void take_up(const EnergyBooks& books) { books_ = books; }

 private:
  double floor_J_;  ///< energies below are those of errors that the tolerances allow
  EnergyBooks books_;
};

}  // namespace flexneck::multibody
