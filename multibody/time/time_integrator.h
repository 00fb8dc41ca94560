// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "multibody/numerics/error_estimate.h"
#include "multibody/time/load_watch.h"

namespace flexneck::multibody {

struct StepLimits {
  double largest_s;
  double smallest_s;
};

/// What decided how long a step is, besides its error.
enum class StepReason {
  error,         ///< of the limiting component
  largest_step,  ///< the largest allowed
  end,           ///< of an interval: a kink of a table or the end of the run
  event,         ///< a load has a kink: a stop is met, friction turns over
  load,          ///< a load given by a function has features that a longer one would miss
  iteration      ///< an implicit method's equations could not be solved over a longer one
};

/// What of a method goes on from step to step besides the state: with it a run that is taken up
/// again goes on as it would have.
struct Pace {
  double proposed_s = 0;  ///< length of the next step; zero: to be chosen
  double error = 1e-4;    ///< of the last step, against what is allowed
};

/// Steps through time with a step size that follows the error.
class TimeIntegrator {
 public:
  using Vector = Eigen::VectorXd;

  TimeIntegrator(const TimeIntegrator&) = delete;
  TimeIntegrator& operator=(const TimeIntegrator&) = delete;
  virtual ~TimeIntegrator() = default;

  /// From now on steps miss no feature of loads that are functions.
  void watch(const ForceSet& loads, double resolution_s) { watch_.emplace(loads, resolution_s); }

  /// Forgets the rate at the present time: after a jump of the right-hand side.
  virtual void restart() = 0;
  /// One accepted step that does not pass `limit_s`.
  /// @throws ComputationError if the step would have to be smaller than the smallest allowed or the
  /// rate is not a number: time and component that limited it.
  virtual void step(double limit_s) = 0;
  virtual Pace pace() const { return {}; }
  virtual void set_pace(const Pace& /*pace*/) {}
  /// The state inside the last step.
  virtual void interpolate(double time_s, Vector& y) const = 0;
  virtual std::string name_of(std::size_t component) const = 0;
  /// Of what happened at the end of a step whose reason is an event.
  virtual std::string name_of_event(std::size_t event) const = 0;

  double time_s() const { return time_s_; }
  const Vector& state() const { return y_; }
  int accepted() const { return accepted_; }
  int rejected() const { return rejected_; }
  /// Component of the largest error and what set the length, of the last step tried.
  std::size_t limiting_component() const { return last_estimate_.component; }
  StepReason reason() const { return reason_; }
  /// At the end of the last step, if that is its reason.
  std::size_t event() const { return event_; }

 protected:
  TimeIntegrator(StepLimits limits, double time_s, const Vector& y)
      : limits_(limits), time_s_(time_s), y_(y) {}
  [[noreturn]] void collapse(const ErrorEstimate& error) const;

  /// Takes the motion of the last evaluation for that at the present time.
  void watch_from_here() {
    if (watch_) watch_->begin();
  }
  /// @param method  at the end of a step, whose last evaluation was there
  /// @return the share of its length that may do, or 1 if the step misses no feature of a load
  double share_seen(double length_s, LoadWatch::Method method) {
    return watch_ ? watch_->share_seen(time_s_, length_s, method) : 1;
  }
  void watch_from_end() {
    if (watch_) watch_->accept();
  }

  StepLimits limits_;
  std::optional<LoadWatch> watch_;
  double time_s_;
  Vector y_;
  ErrorEstimate last_estimate_;
  StepReason reason_ = StepReason::error;
  std::size_t event_ = 0;
  int accepted_ = 0;
  int rejected_ = 0;
};

}  // namespace flexneck::multibody
