// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "multibody/model/model.h"
#include "multibody/model/motion_state.h"
#include "multibody/numerics/error_estimate.h"

namespace flexneck::multibody {

/// The energies that a run has seen: with them it is taken up again.
struct EnergyBooks {
  bool are_open = false;
  double first_balance_J = 0, first_gravitational_J = 0, first_dissipated_J = 0, first_work_J = 0;
  double largest_J = 0;     ///< kinetic, stored or dissipated energy or work, so far
  double worst_J = 0;       ///< by how much the balance was off
  double departs_at_s = 0;  ///< where it began to be off by more than is told
  bool departs = false;
  int wrong_steps = 0;  ///< one after the other
};

/// Watches the balance of energy of a run in time,
///   kinetic + gravitational + strain + dissipated - work,
/// which must stay what it was. It is told where it changes by more than 1e-3 of the run's largest
/// energy, and ends the run where it is off by more than 1e-1 for twenty steps: a motion whose
/// energy is wrong is wrong. A motion that only begins has energies of the size of a step's error;
/// they outgrow it within these steps.
class EnergyGuard {
 public:
  EnergyGuard(const Model& model, Tolerance tolerance);

  /// Looks at the balance at an output, for warnings().
  /// @return by how much it is off, J
  double see(double time_s, const Energies& stored, double dissipated_J, double work_J);
  /// Judges the balance behind each accepted step, and before the first.
  /// @throws ComputationError that says when and by how much the balance is off.
  void check(double time_s, const Energies& stored, double dissipated_J, double work_J);
  /// A sentence if there is something to tell.
  std::vector<std::string> warnings() const;

  const EnergyBooks& books() const { return books_; }
  void take_up(const EnergyBooks& books) { books_ = books; }

 private:
  double floor_J_;        ///< energies below are those of errors that the tolerances allow
  double carried_share_;  ///< of the energy of bodies carried along, in the same way
  EnergyBooks books_;
};

}  // namespace flexneck::multibody
