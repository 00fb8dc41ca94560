// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "multibody/model/model.h"
#include "multibody/model/motion_state.h"
#include "multibody/numerics/error_estimate.h"

namespace flexneck::multibody {

/// The energies of a run so far, with which it can be resumed.
struct EnergyBooks {
  bool are_open = false;
  double first_balance_J = 0, first_gravitational_J = 0, first_dissipated_J = 0, first_work_J = 0;
  double largest_J = 0;     ///< kinetic, stored or dissipated energy or work, so far
  double worst_J = 0;       ///< largest deviation of the balance
  double departs_at_s = 0;  ///< time when the deviation began to exceed the warning limit
  bool departs = false;
  int wrong_steps = 0;  ///< number of consecutive wrong steps
};

/// Monitors the balance of energy of a run in time,
///   kinetic + gravitational + strain + dissipated - work,
/// which must be constant. It warns if the balance changes by more than 1e-3 of the run's largest
/// energy, and ends the run if it deviates by more than 1e-1 for twenty steps: a motion with a
/// wrong energy is wrong. A motion that only begins has energies of the size of a step's error;
/// they outgrow it within these steps.
class EnergyGuard {
 public:
  EnergyGuard(const Model& model, Tolerance tolerance);

  /// Records the balance at an output, for warnings().
  /// @return its deviation, J
  double see(double time_s, const Energies& stored, double dissipated_J, double work_J);
  /// Checks the balance after each accepted step, and before the first.
  /// @throws ComputationError with the time and the size of the deviation.
  void check(double time_s, const Energies& stored, double dissipated_J, double work_J);
  /// A warning if the balance has deviated; else empty.
  std::vector<std::string> warnings() const;

  const EnergyBooks& books() const { return books_; }
  void take_up(const EnergyBooks& books) { books_ = books; }

 private:
  double floor_J_;        ///< energies below it may be errors within the tolerances
  double carried_share_;  ///< the same as a fraction of the energy of carried bodies
  EnergyBooks books_;
};

}  // namespace flexneck::multibody
