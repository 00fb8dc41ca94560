// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/time/motion.h"

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "geometry/foundation/error.h"
#include "multibody/equations/force_set.h"
#include "multibody/history/incomplete_run.h"
#include "multibody/history/recorder.h"
#include "multibody/model/prescribed_path.h"
#include "multibody/time/dormand_prince.h"
#include "multibody/time/generalised_alpha.h"

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Counts what set the lengths of steps.
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
        return "the largest step allowed";
      case StepReason::end:
        return "a kink of a table or the end of the run";
      case StepReason::event:
        return "event: " + integrator.name_of_event(index);
      case StepReason::iteration:
        break;
    }
    return "convergence of Newton's method";
  }

  std::map<std::pair<StepReason, std::size_t>, int> steps_;
};

/// One run: the integrator, and the recorder behind it.
class Run {
 public:
  Run(const Model& model, Equations& equations, const VectorXd& state, const SolverOptions& solver,
      const OutputOptions& output)
      : equations_(equations),
        max_steps_(solver.max_steps),
        checkpoint_(solver.checkpoint),
        recorder_(model, output),
        integrator_(time_integrator(equations, output.begin_time_s, state, solver)),
        output_state_(state) {}

  /// Steps over an interval in which no table has a kink.
  void advance(double begin_s, double end_s) {
    equations_.set_interval(begin_s, end_s);
    integrator_->restart();
    while (integrator_->time_s() < end_s) {
      if (integrator_->accepted() + integrator_->rejected() >= max_steps_) give_up();
      integrator_->step(end_s);
      limits_.count(*integrator_);
      record_until(integrator_->time_s());
      if (checkpoint_) checkpoint_();
    }
  }

  History finish() {
    count_steps();
    return recorder_.take();
  }
  History finish_early(const std::string& why) {
    count_steps();
    return recorder_.take_incomplete(next_, why);
  }

 private:
  void count_steps() {
    StepStatistics& statistics = recorder_.statistics();
    statistics.accepted = integrator_->accepted();
    statistics.rejected = integrator_->rejected();
    statistics.evaluations = equations_.evaluations();
    statistics.limits = limits_.take(*integrator_);
  }
  [[noreturn]] void give_up() const {
    throw ComputationError("the run was given up at " + std::to_string(integrator_->time_s()) +
                           " s after " + std::to_string(max_steps_) +
                           " steps; what limits them is the " +
                           integrator_->name_of(integrator_->limiting_component()));
  }

  void record_until(double time_s) {
    while (next_ < recorder_.columns() && recorder_.time_s(next_) <= time_s) {
      const double at = recorder_.time_s(next_);
      integrator_->interpolate(at, output_state_);
      recorder_.begin(next_);
      equations_.record(at, output_state_, recorder_, next_);
      recorder_.check_turns(next_);
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
  std::unique_ptr<TimeIntegrator> integrator_;
  LimitCounter limits_;
  VectorXd output_state_;
  Index next_ = 0;
};

}  // namespace

std::vector<double> breakpoints(const Model& model, double begin_s, double end_s) {
  std::vector<double> times;
  for (const Body& body : model.bodies) {
    const auto* prescribed = std::get_if<PrescribedBody>(&body.kind);
    if (prescribed == nullptr) continue;
    PrescribedPath(body.initial_pose, *prescribed).add_breakpoints(times);
  }
  for (const Joint& joint : model.joints)
    for (const JointMotor& motor : joint.motors) motor.path.add_breakpoints(times);
  ForceSet(model).add_breakpoints(times);
  std::erase_if(times, [&](double time) { return !(time > begin_s && time < end_s); });
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

std::unique_ptr<TimeIntegrator> time_integrator(Equations& equations, double time_s,
                                                const VectorXd& state,
                                                const SolverOptions& solver) {
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
      [&](std::size_t component) { return equations.name_of(component); }};
  if (!equations.forces().pieces().empty()) {
    problem.pieces = [&]() -> const std::vector<int>& { return equations.forces().pieces(); };
    problem.name_of_piece = [&](std::size_t piece) {
      return equations.forces().name_of_piece(piece);
    };
  }
  return std::make_unique<DormandPrince>(std::move(problem), limits, time_s, state);
}

History integrate(const Model& model, Equations& equations, const VectorXd& state,
                  const SolverOptions& solver, const OutputOptions& output) {
  Run run(model, equations, state, solver, output);
  std::vector<double> ends = breakpoints(model, output.begin_time_s, output.end_time_s);
  ends.push_back(output.end_time_s);
  try {
    double begin = output.begin_time_s;
    for (const double end : ends) {
      run.advance(begin, end);
      begin = end;
    }
  } catch (const ComputationError& error) {
    throw IncompleteRun(error.what(), run.finish_early(error.what()));
  }
  return run.finish();
}

}  // namespace flexneck::multibody
