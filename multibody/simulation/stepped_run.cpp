// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/simulation/stepped_run.h"

#include <utility>

#include "geometry/foundation/error.h"
#include "multibody/history/recorder.h"
#include "multibody/simulation/equations_of.h"
#include "multibody/time/motion.h"
#include "multibody/time/step_follower.h"

namespace flexneck::multibody {
namespace {

/// Calls visit(body, prescribed body) for each prescribed body.
template <class AnyModel, class Visit>
void each_prescribed(AnyModel& model, const Visit& visit) {
  for (auto& body : model.bodies)
    if (auto* const prescribed = std::get_if<PrescribedBody>(&body.kind)) visit(body, *prescribed);
}

/// Calls visit(joint, motor) for each motor.
template <class AnyModel, class Visit>
void each_motor(AnyModel& model, const Visit& visit) {
  for (auto& joint : model.joints)
    for (auto& motor : joint.motors) visit(joint, motor);
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

/// The integrated input at a time from which its second rate has another value.
HeldInput held(const HeldInput& before, double time_s, double second_rate) {
  return {time_s, before.value_at(time_s), before.rate_at(time_s), second_rate};
}

double stored_J(const EnergyHistory& energy) {
  return energy.kinetic_J[0] + energy.gravitational_J[0] + energy.strain_J[0];
}

std::vector<HeldInput> motions_of(const Model& model) {
  std::vector<HeldInput> motions;
  each_prescribed(model, [&](const Body&, const PrescribedBody& body) {
    motions.push_back(body.input);
    motions.push_back(body.turn.input);
  });
  each_motor(model,
             [&](const Joint&, const JointMotor& motor) { motions.push_back(motor.path.input()); });
  return motions;
}

}  // namespace

std::vector<RunInput> inputs_of(const Model& model) {
  std::vector<RunInput> inputs;
  each_prescribed(model, [&](const Body& body, const PrescribedBody&) {
    inputs.push_back({"body." + body.name + ".acceleration", "m/s^2",
                      "Acceleration along the body's direction, in addition to its own motion"});
    inputs.push_back(
        {"body." + body.name + ".angular_acceleration", "rad/s^2",
         "Angular acceleration about the body's axis of rotation, in addition to its own motion"});
  });
  each_motor(model, [&](const Joint& joint, const JointMotor& motor) {
    const bool slides = motor.coordinate == JointCoordinate::distance;
    inputs.push_back(
        {"joint." + joint.name + (slides ? ".acceleration" : ".angular_acceleration"),
         slides ? "m/s^2" : "rad/s^2",
         "Acceleration of the joint's motor '" + motor.name + "', in addition to its own motion"});
  });
  each_load(model, [&](const std::string& name, const std::string& unit, const double&) {
    inputs.push_back({name + ".magnitude", unit, "Load in addition to its own magnitude"});
  });
  return inputs;
}

SteppedRun::SteppedRun(Model model, const SolverOptions& solver, Kind kind,
                       const std::vector<double>& inputs)
    : model_(std::make_unique<Model>(std::move(model))),
      solver_(solver),
      kind_(kind),
      watch_(*model_) {
  check_start(*model_, solver_);
  if (kind_ == Kind::from_equilibrium) check_nothing_turns(*model_);
  state_.time_s = model_->start.time_s;
  state_.inputs.assign(inputs_of(*model_).size(), 0);
  state_.motions = motions_of(*model_);
  for (std::size_t k = 0; k < inputs.size(); ++k) set_input(k, inputs[k]);
  is_changed_ = true;
  rebuild();
  switch (kind_) {
    case Kind::motion:
      state_.y = equations_->given_state();
      break;
    case Kind::from_equilibrium:
      state_.y = equations_->equilibrium_state();
      break;
    case Kind::quasi_static:
      state_.y = equations_->given_place();
      settle(state_.time_s);
      state_.first_energy_J = stored_J(recorded().energy);
      break;
  }
  StepFollower(*equations_, watch_).begin(state_.time_s, state_.y);
  state_.angles = counted_angles(watch_);
}

void SteppedRun::set_input(std::size_t index, double value) {
  if (state_.inputs.at(index) == value) return;
  state_.inputs[index] = value;
  if (index < state_.motions.size())
    state_.motions[index] = held(state_.motions[index], state_.time_s, value);
  state_.is_settled = false;
  is_changed_ = true;
}

void SteppedRun::apply_inputs() {
  std::size_t k = 0;
  each_prescribed(*model_, [&](const Body&, PrescribedBody& body) {
    body.input = state_.motions[k++];
    body.turn.input = state_.motions[k++];
  });
  each_motor(*model_,
             [&](const Joint&, JointMotor& motor) { motor.path.set_input(state_.motions[k++]); });
  each_load(*model_, [&](const std::string&, const std::string&, double& load) {
    load = state_.inputs[k++];
  });
}

void SteppedRun::start_in_turns() {
  auto angle = state_.angles.begin();
  if (angle == state_.angles.end()) return;
  for (Joint& joint : model_->joints) joint.start_angle_rad = *angle++;
  for (MeasuredAngle& measured : model_->angles) measured.start_rad = *angle++;
}

std::vector<double> SteppedRun::counted_angles(const RunWatch& watch) const {
  std::vector<double> angles;
  for (std::size_t k = 0; k < model_->joints.size(); ++k)
    angles.push_back(equations_->joint_angle_rad(k));
  for (std::size_t k = 0; k < watch.angles().size(); ++k)
    angles.push_back(watch.angles().angle_rad(k));
  return angles;
}

void SteppedRun::rebuild() {
  if (!is_changed_) return;
  apply_inputs();
  start_in_turns();
  equations_ =
      equations_of(*model_, solver_, kind_ == Kind::quasi_static ? Drive::held : Drive::prescribed);
  is_changed_ = false;
}

void SteppedRun::advance(double end_s, const GoesOn& goes_on) {
  rebuild();
  try {
    if (kind_ == Kind::quasi_static)
      settle(end_s);
    else
      integrate(end_s, goes_on);
  } catch (...) {
    is_changed_ = true;  // the equations have counted turns that the state does not have
    throw;
  }
}

void SteppedRun::integrate(double end_s, const GoesOn& goes_on) {
  const StepEnds ends(*model_, solver_, state_.time_s, end_s);
  const std::unique_ptr<TimeIntegrator> integrator =
      time_integrator(*equations_, state_.time_s, state_.y, solver_);
  integrator->set_pace(state_.pace);
  RunWatch watch = watch_;
  StepFollower follower(*equations_, watch);
  follower.begin(state_.time_s, state_.y);
  StepGuards guards(*model_, solver_, *equations_);
  if (state_.books.are_open) guards.take_up(state_.books);
  double begin = state_.time_s;
  bool is_ended = false;
  for (const double end : ends.kinks_s()) {
    if (is_ended) break;
    equations_->set_interval(begin, end);
    if (!guards.books().are_open) guards.begin(begin, state_.y);
    integrator->restart();
    while (!is_ended && integrator->time_s() < end) {
      if (integrator->accepted() + integrator->rejected() >= solver_.max_steps)
        throw ComputationError("the run was stopped after " + std::to_string(solver_.max_steps) +
                               " steps; the step size is limited by the " +
                               integrator->name_of(integrator->limiting_component()));
      integrator->step(ends.limit_s(integrator->time_s(), end));
      guards.check(*integrator);
      follower.follow(*integrator, [](double) {});
      const double time_s = integrator->time_s();
      is_ended = goes_on && time_s < end_s && !goes_on(time_s);
    }
    begin = end;
  }
  state_.time_s = is_ended ? integrator->time_s() : end_s;
  state_.y = integrator->state();
  state_.pace = integrator->pace();
  state_.angles = counted_angles(watch);
  watch_ = std::move(watch);
  state_.books = guards.books();
}

void SteppedRun::settle(double time_s) {
  check_motions_reach(*model_, time_s);
  Eigen::VectorXd y = state_.y;
  RunWatch watch = watch_;
  settle_until(*model_, *equations_, watch, state_.time_s, time_s, y);
  state_.angles = counted_angles(watch);
  watch_ = std::move(watch);
  state_.y = y;
  state_.time_s = time_s;
  state_.is_settled = true;
}

History SteppedRun::output() {
  rebuild();
  if (kind_ == Kind::quasi_static && !state_.is_settled) settle(state_.time_s);
  return recorded();
}

History SteppedRun::recorded() {
  OutputOptions one;
  one.begin_time_s = one.end_time_s = state_.time_s;
  Recorder recorder(*model_, one, watch_);
  Eigen::VectorXd y = state_.y;
  if (kind_ != Kind::quasi_static) {
    Eigen::VectorXd rate(y.size());
    equations_->set_interval(state_.time_s, state_.time_s);
    equations_->derivative(state_.time_s, y, rate);
  }
  equations_->record(state_.time_s, y, recorder, 0);
  recorder.look(0);
  History history = recorder.take();
  // Nothing is dissipated: the work is the gain of the energies.
  if (kind_ != Kind::quasi_static) {
    EnergyGuard guard(*model_, {solver_.relative_tolerance, solver_.absolute_tolerance});
    guard.take_up(state_.books);
    for (const std::string& each : guard.warnings()) history.warnings.push_back(each);
  } else
    history.energy.work_J[0] = stored_J(history.energy) - state_.first_energy_J;
  return history;
}

void SteppedRun::restore(const State& state) {
  if (state.y.size() != state_.y.size() || state.inputs.size() != state_.inputs.size() ||
      state.motions.size() != state_.motions.size() || state.angles.size() != state_.angles.size())
    throw InputError("the state belongs to another model");
  state_ = state;
  is_changed_ = true;
  start_in_turns();
  watch_ = RunWatch(*model_);
}

}  // namespace flexneck::multibody
