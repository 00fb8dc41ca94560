// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "multibody/equations/equations.h"
#include "multibody/history/history.h"
#include "multibody/model/model.h"
#include "multibody/time/time_integrator.h"

namespace flexneck::multibody {

/// What others may give a model while it runs: the second rate of a prescribed body's travel along
/// its direction or of its turn about its axis, or the load of a force, torque or line force. It is
/// added to what the model says itself.
struct RunInput {
  std::string name;  ///< such as "body.sled.acceleration" or "force.push.magnitude"
  std::string unit;
  std::string what;
};
/// Prescribed bodies in their order, then loads by kinds.
std::vector<RunInput> inputs_of(const Model& model);

/// A run that others drive: from one time to the next, with inputs that hold from a time on, and a
/// state that is taken and given back.
class SteppedRun {
 public:
  enum class Start { given, equilibrium };

  /// All that a run goes on from.
  struct State {
    double time_s = 0;
    Eigen::VectorXd y;      ///< of the equations
    double proposed_s = 0;  ///< see Pace
    double error = 0;
    std::vector<double> inputs;     ///< their values
    std::vector<HeldInput> travel;  ///< of the prescribed bodies, and
    std::vector<HeldInput> turn;
  };

  /// @param inputs  values from the start on, which an equilibrium is under; empty: zero
  /// @throws as simulate() and simulate_from_equilibrium() do before their first step.
  SteppedRun(Model model, const SolverOptions& solver, Start start,
             const std::vector<double>& inputs = {});
  SteppedRun(const SteppedRun&) = delete;
  SteppedRun& operator=(const SteppedRun&) = delete;

  double time_s() const { return state_.time_s; }
  const Model& model() const { return *model_; }
  double input(std::size_t index) const { return state_.inputs.at(index); }
  /// From the present time on.
  void set_input(std::size_t index, double value);

  /// @throws ComputationError if the run cannot go on: time and what limited it. The state is that
  /// of before.
  void advance(double end_s);
  /// Of the present time: one output.
  History output();

  const State& state() const { return state_; }
  /// @throws InputError if it is of another model.
  void restore(const State& state);

 private:
  void apply_inputs();
  void rebuild();

  std::unique_ptr<Model> model_;  ///< the equations refer to it
  SolverOptions solver_;
  std::unique_ptr<Equations> equations_;
  std::unique_ptr<TimeIntegrator> integrator_;
  State state_;
  bool is_changed_ = false;  ///< inputs have, since the equations were made
};

}  // namespace flexneck::multibody
