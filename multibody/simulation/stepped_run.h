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

/// An input that the caller may set while a model runs: the second rate of a prescribed body's
/// travel along its direction or of its rotation about its axis, that of a joint's distance or
/// angle which a motor prescribes, or the load of a force, torque or line force. It is added to the
/// model's own value.
struct RunInput {
  std::string name;  ///< such as "body.sled.acceleration" or "force.push.magnitude"
  std::string unit;
  std::string what;
};
/// The inputs of a model: those of prescribed bodies, then of motors in their order, then of loads
/// by kinds.
std::vector<RunInput> inputs_of(const Model& model);

/// A run advanced by the caller from one time to the next, with inputs that are constant from a
/// time on, and a state that can be saved and restored.
class SteppedRun {
 public:
  /// Function of simulation.h that the run corresponds to: simulate(), simulate_from_equilibrium(),
  /// settle().
  enum class Kind { motion, from_equilibrium, quasi_static };

  /// The complete state from which a run continues.
  struct State {
    double time_s = 0;
    Eigen::VectorXd y;  ///< state vector of the equations
    Pace pace = {};
    std::vector<double> inputs;      ///< their values
    std::vector<HeldInput> motions;  ///< integrals of the inputs that are second rates
    std::vector<double> angles;      ///< with counted turns, rad: of the joints, then measured ones
    /// In a quasi-static run: true if y is the equilibrium under these inputs, and the energy
    /// stored in the first one.
    bool is_settled = true;
    double first_energy_J = 0;
    EnergyBooks books;  ///< for a run in time
  };

  /// @param inputs  values from the start on, also for an initial equilibrium; empty: zero
  /// @throws as the function of this kind does before its first step.
  SteppedRun(Model model, const SolverOptions& solver, Kind kind,
             const std::vector<double>& inputs = {});
  SteppedRun(const SteppedRun&) = delete;
  SteppedRun& operator=(const SteppedRun&) = delete;

  double time_s() const { return state_.time_s; }
  const Model& model() const { return *model_; }
  double input(std::size_t index) const { return state_.inputs.at(index); }
  /// Sets an input from the present time on.
  void set_input(std::size_t index, double value);

  /// Called after each step of the integrator that ends before the end; returns false to stop
  /// there.
  using GoesOn = std::function<bool(double time_s)>;

  /// Advances the run.
  /// @throws ComputationError if the run cannot go on, with the time and the limiting component.
  /// The state is then that before the call.
  void advance(double end_s, const GoesOn& goes_on = {});
  /// One output, at the present time.
  History output();

  const State& state() const { return state_; }
  /// Restores a state.
  /// @throws InputError if it belongs to another model.
  void restore(const State& state);

 private:
  void apply_inputs();
  void rebuild();
  /// Sets the model's start angles to the state's, with their counted turns.
  void start_in_turns();
  std::vector<double> counted_angles(const RunWatch& watch) const;
  void integrate(double end_s, const GoesOn& goes_on);
  /// Finds the equilibrium at a time.
  /// @throws ComputationError, with the state unchanged.
  void settle(double time_s);
  History recorded();

  std::unique_ptr<Model> model_;  ///< the equations refer to it
  SolverOptions solver_;
  Kind kind_;
  std::unique_ptr<Equations> equations_;
  RunWatch watch_;
  State state_;
  bool is_changed_ = false;  ///< inputs have changed since the equations were created
};

}  // namespace flexneck::multibody
