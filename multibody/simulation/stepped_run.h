// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "multibody/equations/equations.h"
#include "multibody/history/energy_guard.h"
#include "multibody/history/history.h"
#include "multibody/history/run_watch.h"
#include "multibody/model/model.h"
#include "multibody/time/time_integrator.h"

namespace flexneck::multibody {

/// What others may give a model while it runs: the second rate of a prescribed body's travel along
/// its direction or of its turn about its axis, that of a joint's distance or angle which a motor
/// gives, or the load of a force, torque or line force. It is added to what the model says itself.
struct RunInput {
  std::string name;  ///< such as "body.sled.acceleration" or "force.push.magnitude"
  std::string unit;
  std::string what;
};
/// Prescribed bodies, then motors in their order, then loads by kinds.
std::vector<RunInput> inputs_of(const Model& model);

/// A run that others drive: from one time to the next, with inputs that hold from a time on, and a
/// state that is taken and given back.
class SteppedRun {
 public:
  /// Which one of simulation.h: simulate(), simulate_from_equilibrium(), settle().
  enum class Kind { motion, from_equilibrium, quasi_static };

  /// All that a run goes on from.
  struct State {
    double time_s = 0;
    Eigen::VectorXd y;  ///< of the equations
    Pace pace = {};
    std::vector<double> inputs;      ///< their values
    std::vector<HeldInput> motions;  ///< what those of them that are second rates have come to
    std::vector<double> angles;      ///< that count turns, rad: of the joints, then those measured
    /// Of a quasi-static run: whether y is the equilibrium under these inputs, and the energy that
    /// was stored in the first one.
    bool is_settled = true;
    double first_energy_J = 0;
    EnergyBooks books;  ///< of a run in time
  };

  /// @param inputs  values from the start on, which an equilibrium is under; empty: zero
  /// @throws as the function of this kind does before its first step.
  SteppedRun(Model model, const SolverOptions& solver, Kind kind,
             const std::vector<double>& inputs = {});
  SteppedRun(const SteppedRun&) = delete;
  SteppedRun& operator=(const SteppedRun&) = delete;

  double time_s() const { return state_.time_s; }
  const Model& model() const { return *model_; }
  double input(std::size_t index) const { return state_.inputs.at(index); }
  /// From the present time on.
  void set_input(std::size_t index, double value);

  /// Asked after each step of the integrator that ends before the end; false ends it there.
  using GoesOn = std::function<bool(double time_s)>;

  /// @throws ComputationError if the run cannot go on: time and what limited it. The state is that
  /// of before.
  void advance(double end_s, const GoesOn& goes_on = {});
  /// Of the present time: one output.
  History output();

  const State& state() const { return state_; }
  /// @throws InputError if it is of another model.
  void restore(const State& state);

 private:
  void apply_inputs();
  void rebuild();
  /// Takes the turns that the state has counted for those of the model's start.
  void start_in_turns();
  std::vector<double> counted_angles(const RunWatch& watch) const;
  void integrate(double end_s, const GoesOn& goes_on);
  /// Looks for the equilibrium at a time. @throws ComputationError, with the state of before.
  void settle(double time_s);
  History recorded();

  std::unique_ptr<Model> model_;  ///< the equations refer to it
  SolverOptions solver_;
  Kind kind_;
  std::unique_ptr<Equations> equations_;
  RunWatch watch_;
  State state_;
  bool is_changed_ = false;  ///< inputs have, since the equations were made
};

}  // namespace flexneck::multibody
