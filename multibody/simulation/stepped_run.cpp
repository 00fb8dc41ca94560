// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/simulation/stepped_run.h"

#include <utility>

#include "geometry/foundation/error.h"
#include "multibody/history/recorder.h"
#include "multibody/simulation/equations_of.h"
#include "multibody/time/motion.h"

namespace flexneck::multibody {
namespace {

/// Calls visit(body, prescribed body) for each.
template <class AnyModel, class Visit>
void each_prescribed(AnyModel& model, const Visit& visit) {
  for (auto& body : model.bodies)
    if (auto* const prescribed = std::get_if<PrescribedBody>(&body.kind)) visit(body, *prescribed);
}

/// Calls visit(name, unit, load) for the loads that have an input, by kinds.
template <class AnyModel, class Visit>
void each_load(AnyModel& model, const Visit& visit) {
  for (auto& force : model.forces.template of<PointForce>())
    visit("force." + force.name, "N", force.input_N);
  for (auto& torque : model.forces.template of<Torque>())
    visit("torque." + torque.name, "N m", torque.input_Nm);
  for (auto& force : model.forces.template of<LineForce>())
    visit("line_force." + force.name, "N", force.input_N);
}

/// What an input has come to at a time, from which it has another value.
HeldInput held(const HeldInput& before, double time_s, double second_rate) {
  return {time_s, before.value_at(time_s), before.rate_at(time_s), second_rate};
}

}  // namespace

std::vector<RunInput> inputs_of(const Model& model) {
  std::vector<RunInput> inputs;
  each_prescribed(model, [&](const Body& body, const PrescribedBody&) {
    inputs.push_back({"body." + body.name + ".acceleration", "m/s^2",
                      "Along the body's direction, besides its own motion"});
    inputs.push_back({"body." + body.name + ".angular_acceleration", "rad/s^2",
                      "About the body's axis of rotation, besides its own motion"});
  });
  each_load(model, [&](const std::string& name, const std::string& unit, const double&) {
    inputs.push_back({name + ".magnitude", unit, "Besides its own magnitude"});
  });
  return inputs;
}

SteppedRun::SteppedRun(Model model, const SolverOptions& solver, Start start,
                       const std::vector<double>& inputs)
    : model_(std::make_unique<Model>(std::move(model))), solver_(solver) {
  check_start(*model_, solver_);
  if (start == Start::equilibrium) check_nothing_turns(*model_);
  state_.time_s = model_->start.time_s;
  state_.inputs.assign(inputs_of(*model_).size(), 0);
  each_prescribed(*model_, [&](const Body&, const PrescribedBody& body) {
    state_.travel.push_back(body.input);
    state_.turn.push_back(body.turn.input);
  });
  for (std::size_t k = 0; k < inputs.size(); ++k) set_input(k, inputs[k]);
  apply_inputs();
  is_changed_ = false;
  equations_ = equations_of(*model_, solver_);
  state_.y =
      start == Start::equilibrium ? equations_->equilibrium_state() : equations_->given_state();
  integrator_ = time_integrator(*equations_, state_.time_s, state_.y, solver_);
}

void SteppedRun::set_input(std::size_t index, double value) {
  if (state_.inputs.at(index) == value) return;
  state_.inputs[index] = value;
  const std::size_t body = index / 2;
  if (body < state_.travel.size()) {
    HeldInput& input = index % 2 == 0 ? state_.travel[body] : state_.turn[body];
    input = held(input, state_.time_s, value);
  }
  is_changed_ = true;
}

void SteppedRun::apply_inputs() {
  std::size_t k = 0;
  each_prescribed(*model_, [&](const Body&, PrescribedBody& body) {
    body.input = state_.travel[k];
    body.turn.input = state_.turn[k];
    ++k;
  });
  k *= 2;
  each_load(*model_, [&](const std::string&, const std::string&, double& load) {
    load = state_.inputs[k++];
  });
}

void SteppedRun::rebuild() {
  if (is_changed_) {
    apply_inputs();
    equations_ = equations_of(*model_, solver_);
    is_changed_ = false;
  }
  integrator_ = time_integrator(*equations_, state_.time_s, state_.y, solver_);
  integrator_->set_pace({state_.proposed_s, state_.error});
}

void SteppedRun::advance(double end_s) {
  std::vector<double> ends = breakpoints(*model_, state_.time_s, end_s);
  ends.push_back(end_s);
  rebuild();
  double begin = state_.time_s;
  for (const double end : ends) {
    equations_->set_interval(begin, end);
    integrator_->restart();
    while (integrator_->time_s() < end) {
      if (integrator_->accepted() + integrator_->rejected() >= solver_.max_steps)
        throw ComputationError("the run was given up after " + std::to_string(solver_.max_steps) +
                               " steps; what limits them is the " +
                               integrator_->name_of(integrator_->limiting_component()));
      integrator_->step(end);
    }
    begin = end;
  }
  const Pace pace = integrator_->pace();
  state_.time_s = end_s;
  state_.y = integrator_->state();
  state_.proposed_s = pace.proposed_s;
  state_.error = pace.error;
}

History SteppedRun::output() {
  if (is_changed_) rebuild();
  OutputOptions one;
  one.begin_time_s = one.end_time_s = state_.time_s;
  Recorder recorder(*model_, one);
  Eigen::VectorXd y = state_.y;
  Eigen::VectorXd rate(y.size());
  equations_->set_interval(state_.time_s, state_.time_s);
  equations_->derivative(state_.time_s, y, rate);
  equations_->record(state_.time_s, y, recorder, 0);
  recorder.check_turns(0);
  return recorder.take();
}

void SteppedRun::restore(const State& state) {
  if (state.y.size() != state_.y.size() || state.inputs.size() != state_.inputs.size() ||
      state.travel.size() != state_.travel.size() || state.turn.size() != state_.turn.size())
    throw InputError("the state is one of another model");
  state_ = state;
  is_changed_ = true;
}

}  // namespace flexneck::multibody
