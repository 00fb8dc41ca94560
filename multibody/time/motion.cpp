// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/time/motion.h"

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "multibody/equations/force_set.h"
#include "multibody/history/incomplete_run.h"
#include "multibody/history/recorder.h"
#include "multibody/time/dormand_prince.h"
#include "multibody/time/generalised_alpha.h"
#include "multibody/time/step_follower.h"

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Number of steps in a piece of a motion, which is shorter than a period: for a method with
/// stages, and for one that evaluates only the ends of steps.
constexpr int kPartsOfStages = 2;
constexpr int kPartsOfEnds = 8;

/// Counts the causes that limited the lengths of steps.
class LimitCounter {
 public:
  void count(const TimeIntegrator& integrator) {
    const StepReason reason = integrator.reason();
    ++steps_[{reason, reason == StepReason::error   ? integrator.limiting_component()
                      : reason == StepReason::event ? integrator.event()
                                                    : 0}];
  }
  std::vector<StepLimit> take(const TimeIntegrator& integrator) const {
    std::vector<StepLimit> limits;
    for (const auto& [cause, steps] : steps_) {
      const auto& [reason, component] = cause;
      limits.push_back({name_of(reason, component, integrator), steps});
    }
    std::stable_sort(limits.begin(), limits.end(),
                     [](const StepLimit& a, const StepLimit& b) { return a.steps > b.steps; });
    return limits;
  }

 private:
  static std::string name_of(StepReason reason, std::size_t index,
                             const TimeIntegrator& integrator) {
    switch (reason) {
      case StepReason::error:
        return "error: " + integrator.name_of(index);
      case StepReason::largest_step:
        return "the maximum step size";
      case StepReason::end:
        return "a kink of a table, a piece of a motion or the end of the run";
      case StepReason::event:
        return "event: " + integrator.name_of_event(index);
      case StepReason::load:
        return "fast changes of a load that is given by a function";
      case StepReason::iteration:
        break;
    }
    return "convergence of Newton's method";
  }

  std::map<std::pair<StepReason, std::size_t>, int> steps_;
};

/// One run: the integrator and its recorder.
class Run {
 public:
  Run(const Model& model, Equations& equations, const VectorXd& state, const SolverOptions& solver,
      const OutputOptions& output)
      : equations_(equations),
        max_steps_(solver.max_steps),
        checkpoint_(solver.checkpoint),
        recorder_(model, output),
        ends_(model, solver, output.begin_time_s, output.end_time_s),
        integrator_(time_integrator(equations, output.begin_time_s, state, solver)),
        follower_(equations, recorder_.watch()),
        guards_(model, solver, equations),
        output_state_(state) {}

  void run(double begin_s) {
    follower_.begin(integrator_->time_s(), integrator_->state());
    for (const double end_s : ends_.kinks_s()) {
      advance(begin_s, end_s);
      begin_s = end_s;
    }
  }

  History finish() {
    count_steps();
    return warned(recorder_.take());
  }
  History finish_early(const std::string& why) {
    count_steps();
    return warned(recorder_.take_incomplete(next_, why));
  }

 private:
  /// Steps over an interval in which no table has a kink.
  void advance(double begin_s, double end_s) {
    equations_.set_interval(begin_s, end_s);
    if (integrator_->accepted() == 0) guards_.begin(begin_s, integrator_->state());
    integrator_->restart();
    while (integrator_->time_s() < end_s) {
      if (integrator_->accepted() + integrator_->rejected() >= max_steps_) give_up();
      integrator_->step(ends_.limit_s(integrator_->time_s(), end_s));
      limits_.count(*integrator_);
      guards_.check(*integrator_);
      follower_.follow(*integrator_, [&](double time_s) { record_until(time_s); });
      if (checkpoint_) checkpoint_();
    }
  }

  History warned(History history) const {
    for (const std::string& each : guards_.warnings()) history.warnings.push_back(each);
    return history;
  }
  void count_steps() {
    StepStatistics& statistics = recorder_.statistics();
    statistics.accepted = integrator_->accepted();
    statistics.rejected = integrator_->rejected();
    statistics.evaluations = equations_.evaluations();
    statistics.limits = limits_.take(*integrator_);
  }
  [[noreturn]] void give_up() const {
    throw ComputationError("the run was stopped at " + rounded_text(integrator_->time_s()) +
                           " s after " + std::to_string(max_steps_) +
                           " steps; the step size is limited by the " +
                           integrator_->name_of(integrator_->limiting_component()));
  }

  void record_until(double time_s) {
    while (next_ < recorder_.columns() && recorder_.time_s(next_) <= time_s) {
      const double at = recorder_.time_s(next_);
      integrator_->interpolate(at, output_state_);
      recorder_.begin(next_);
      equations_.record(at, output_state_, recorder_, next_);
      guards_.see_output(at, output_state_);
      recorder_.look(next_);
      if (next_ == 0)
        recorder_.mobility(equations_.freedoms(), equations_.redundant_constraints(),
                           equations_.doubts());
      ++next_;
    }
  }

  Equations& equations_;
  int max_steps_;
  std::function<void()> checkpoint_;
  Recorder recorder_;
  StepEnds ends_;
  std::unique_ptr<TimeIntegrator> integrator_;
  StepFollower follower_;
  StepGuards guards_;
  LimitCounter limits_;
  VectorXd output_state_;
  Index next_ = 0;
};

}  // namespace

void StepGuards::begin(double time_s, const VectorXd& state) {
  VectorXd rate(state.size());
  equations_.derivative(time_s, state, rate);
  check_energy(time_s, state);
}

void StepGuards::check(const TimeIntegrator& integrator) {
  check_energy(integrator.time_s(), integrator.state());
  chatter_.check(integrator);
}

void StepGuards::see_output(double time_s, const VectorXd& state) {
  const Index last = state.size() - 1;
  energy_.see(time_s, equations_.energies(state), state[last - 1], state[last]);
}

void StepGuards::check_energy(double time_s, const VectorXd& state) {
  const Index last = state.size() - 1;
  energy_.check(time_s, equations_.energies(state), state[last - 1], state[last]);
}

namespace {

/// Calls visit(motion) for each motion given by a function of time.
template <class Visit>
void each_function_of_time(const Model& model, const Visit& visit) {
  for (const Body& body : model.bodies)
    if (const auto* prescribed = std::get_if<PrescribedBody>(&body.kind)) {
      visit(prescribed->motion);
      visit(prescribed->turn.motion);
    }
  for (const Joint& joint : model.joints)
    for (const JointMotor& motor : joint.motors) visit(motor.path.function());
}

void add(const std::vector<double>& rows, std::vector<double>& times_s) {
  times_s.insert(times_s.end(), rows.begin(), rows.end());
}

/// Keeps the times inside (begin, end), ascending and distinct.
void sort_inside(double begin_s, double end_s, std::vector<double>& times_s) {
  std::erase_if(times_s, [&](double time) { return !(time > begin_s && time < end_s); });
  std::sort(times_s.begin(), times_s.end());
  times_s.erase(std::unique(times_s.begin(), times_s.end()), times_s.end());
}

}  // namespace

void check_motions_reach(const Model& model, double end_s) {
  constexpr double kRounding = 1e-9;
  each_function_of_time(model, [&](const SmoothMotion& motion) {
    if (!motion.is_none() && end_s > motion.end_s() * (1 + kRounding))
      throw InputError("the prescribed motions end at " + exact_text(motion.end_s()) +
                       " s, before " + exact_text(end_s) +
                       " s; make the model with a later end_time");
  });
}

StepEnds::StepEnds(const Model& model, const SolverOptions& solver, double begin_s, double end_s) {
  const int parts = solver.integrator == Integrator::dormand_prince ? kPartsOfStages : kPartsOfEnds;
  check_motions_reach(model, end_s);
  for (const Body& body : model.bodies) {
    const auto* prescribed = std::get_if<PrescribedBody>(&body.kind);
    if (prescribed == nullptr) continue;
    add(prescribed->acceleration_m_s2.times_s(), kinks_s_);
    add(prescribed->motion.breakpoints_s(), kinks_s_);
    add(prescribed->turn.acceleration_rad_s2.times_s(), kinks_s_);
    add(prescribed->turn.motion.breakpoints_s(), kinks_s_);
  }
  for (const Joint& joint : model.joints)
    for (const JointMotor& motor : joint.motors) motor.path.add_breakpoints(kinks_s_);
  ForceSet(model).add_breakpoints(kinks_s_);
  sort_inside(begin_s, end_s, kinks_s_);
  kinks_s_.push_back(end_s);
  each_function_of_time(model, [&](const SmoothMotion& motion) {
    motion.add_piece_ends(begin_s, end_s, parts, solver.max_step_s, piece_ends_s_);
  });
  sort_inside(begin_s, end_s, piece_ends_s_);
}

double StepEnds::limit_s(double time_s, double interval_end_s) const {
  const auto next = std::upper_bound(piece_ends_s_.begin(), piece_ends_s_.end(), time_s);
  return next == piece_ends_s_.end() ? interval_end_s : std::min(*next, interval_end_s);
}

namespace {

std::unique_ptr<TimeIntegrator> integrator_of(Equations& equations, double time_s,
                                              const VectorXd& state, const SolverOptions& solver) {
  const StepLimits limits{solver.max_step_s, solver.min_step_s};
  if (solver.integrator == Integrator::generalised_alpha)
    return std::make_unique<GeneralisedAlpha>(equations, solver.spectral_radius, limits, time_s,
                                              state);
  InitialValueProblem problem{
      [&](double t, const VectorXd& y, VectorXd& rate) { equations.derivative(t, y, rate); },
      [&](double t, VectorXd& y, VectorXd& rate) { equations.finish_step(t, y, rate); },
      [&](const VectorXd& begin, const VectorXd& end, const VectorXd& error) {
        return equations.measure(begin, end, error);
      },
      [&](std::size_t component) { return equations.name_of(component); }, &equations.forces()};
  return std::make_unique<DormandPrince>(std::move(problem), limits, time_s, state);
}

}  // namespace

std::unique_ptr<TimeIntegrator> time_integrator(Equations& equations, double time_s,
                                                const VectorXd& state,
                                                const SolverOptions& solver) {
  auto integrator = integrator_of(equations, time_s, state, solver);
  bool has_functions = false;
  equations.forces().each_function(
      [&](const auto&, const auto&, const auto&) { has_functions = true; });
  if (has_functions) integrator->watch(equations.forces(), solver.resolution_s);
  return integrator;
}

History integrate(const Model& model, Equations& equations, const VectorXd& state,
                  const SolverOptions& solver, const OutputOptions& output) {
  Run run(model, equations, state, solver, output);
  try {
    run.run(output.begin_time_s);
  } catch (const ComputationError& error) {
    throw IncompleteRun(error.what(), run.finish_early(error.what()));
  }
  return run.finish();
}

}  // namespace flexneck::multibody
