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

/// Cause that determined the length of a step.
enum class StepReason {
  error,         ///< error of the limiting component
  largest_step,  ///< the largest allowed step
  end,           ///< end of an interval: a kink of a table or the end of the run
  event,         ///< a load has a kink: a stop is met, friction reverses
  load,          ///< a load given by a function has features that a longer step would miss
  iteration      ///< an implicit method's equations could not be solved over a longer step
};

/// State of the step control, with which a resumed run takes the same steps as without
/// interruption.
struct Pace {
  double proposed_s = 0;  ///< length of the next step; zero: not yet chosen
  double error = 1e-4;    ///< error of the last step, relative to the tolerance
};

/// A time integration method with error-controlled steps.
class TimeIntegrator {
 public:
  using Vector = Eigen::VectorXd;

  TimeIntegrator(const TimeIntegrator&) = delete;
  TimeIntegrator& operator=(const TimeIntegrator&) = delete;
  virtual ~TimeIntegrator() = default;

  /// Makes the following steps resolve every feature of loads given by functions.
  void watch(const ForceSet& loads, double resolution_s) { watch_.emplace(loads, resolution_s); }

  /// Discards the rate at the present time, after a jump of the right-hand side.
  virtual void restart() = 0;
  /// Takes one accepted step that does not pass `limit_s`.
  /// @throws ComputationError if the step would have to be smaller than the smallest allowed or the
  /// rate is NaN, with the time and the limiting component.
  virtual void step(double limit_s) = 0;
  virtual Pace pace() const { return {}; }
  virtual void set_pace(const Pace& /*pace*/) {}
  /// Interpolates the state inside the last step.
  virtual void interpolate(double time_s, Vector& y) const = 0;
  virtual std::string name_of(std::size_t component) const = 0;
  /// Description of the event at the end of a step whose reason is an event.
  virtual std::string name_of_event(std::size_t event) const = 0;

  double time_s() const { return time_s_; }
  const Vector& state() const { return y_; }
  int accepted() const { return accepted_; }
  int rejected() const { return rejected_; }
  /// Component of the largest error and cause of the length, of the last step tried.
  std::size_t limiting_component() const { return last_estimate_.component; }
  StepReason reason() const { return reason_; }
  /// Event at the end of the last step, if that is its reason.
  std::size_t event() const { return event_; }

 protected:
  TimeIntegrator(StepLimits limits, double time_s, const Vector& y)
      : limits_(limits), time_s_(time_s), y_(y) {}
  [[noreturn]] void collapse(const ErrorEstimate& error) const;

  /// Takes the motion of the last evaluation as that at the present time.
  void watch_from_here() {
    if (watch_) watch_->begin();
  }
  /// Checks a step for features of loads that it misses, after an evaluation at its end.
  /// @return 1 if the step misses no feature of a load, otherwise the fraction of its length to try
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
