// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "multibody/equations/equations.h"
#include "multibody/equations/solver_options.h"
#include "multibody/history/energy_guard.h"
#include "multibody/history/history.h"
#include "multibody/history/output_options.h"
#include "multibody/history/run_watch.h"
#include "multibody/model/model.h"
#include "multibody/time/chatter_guard.h"
#include "multibody/time/time_integrator.h"

namespace flexneck::multibody {

/// The integrator of the options, starting from a state. The equations must outlive it.
std::unique_ptr<TimeIntegrator> time_integrator(Equations& equations, double time_s,
                                                const Eigen::VectorXd& state,
                                                const SolverOptions& solver);

/// The guards that check each accepted step of a run in time.
class StepGuards {
 public:
  /// @param equations  must outlive this
  StepGuards(const Model& model, const SolverOptions& solver, Equations& equations)
      : equations_(equations),
        energy_(model, {solver.relative_tolerance, solver.absolute_tolerance}),
        chatter_(equations) {}

  /// Starts the guards before the first step of a run.
  void begin(double time_s, const Eigen::VectorXd& state);
  /// Starts the guards where a run is resumed, instead of begin().
  void take_up(const EnergyBooks& books) { energy_.take_up(books); }
  const EnergyBooks& books() const { return energy_.books(); }
  /// Checks an output, whose state was evaluated last.
  void see_output(double time_s, const Eigen::VectorXd& state);
  /// Checks the end of each accepted step.
  /// @throws ComputationError as EnergyGuard and ChatterGuard do.
  void check(const TimeIntegrator& integrator);
  std::vector<std::string> warnings() const { return energy_.warnings(); }

 private:
  void check_energy(double time_s, const Eigen::VectorXd& state);

  Equations& equations_;
  EnergyGuard energy_;
  ChatterGuard chatter_;
};

/// Checks the range of motions given over time.
/// @throws InputError if one ends before `end_s`.
void check_motions_reach(const Model& model, double end_s);

/// Times at which steps end between two times.
class StepEnds {
 public:
  /// @throws InputError as check_motions_reach()
  StepEnds(const Model& model, const SolverOptions& solver, double begin_s, double end_s);

  /// Times at which a table or a motion has a kink or a jump, ascending and distinct, and the end.
  const std::vector<double>& kinks_s() const { return kinks_s_; }
  /// Time that a step must not pass within an interval: the end of a part of a piece of a motion.
  double limit_s(double time_s, double interval_end_s) const;

 private:
  std::vector<double> kinks_s_, piece_ends_s_;
};

/// Finds the static equilibrium at a time, sought from a state at rest at an earlier one, over
/// intermediate times between which prescribed rotations are a radian at most.
/// @param equations  with fixed prescribed bodies
/// @throws ComputationError if one is not found.
void settle_until(const Model& model, Equations& equations, RunWatch& watch, double begin_s,
                  double end_s, Eigen::VectorXd& state);

/// Static equilibria at the output times, each sought from the one before.
/// @param equations  with fixed prescribed bodies
/// @param checkpoint  called after each output, as SolverOptions says; may be empty
/// @throws IncompleteRun if one is not found.
History settle_along(const Model& model, Equations& equations,
                     const std::function<void()>& checkpoint, const OutputOptions& output);

/// Integrates from a state at the start of the outputs that satisfies the joints, and records at
/// the output times.
/// @throws IncompleteRun as simulate().
History integrate(const Model& model, Equations& equations, const Eigen::VectorXd& state,
                  const SolverOptions& solver, const OutputOptions& output);

}  // namespace flexneck::multibody
