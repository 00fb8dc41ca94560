// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "multibody/numerics/error_estimate.h"
#include "multibody/time/event_search.h"
#include "multibody/time/time_integrator.h"

namespace flexneck::multibody {

/// Initial value problem for DormandPrince. Vectors keep their size; the functions should not
/// allocate.
struct InitialValueProblem {
  using Vector = Eigen::VectorXd;

  std::function<void(double time_s, const Vector& y, Vector& rate)> derivative;
  /// Projects the end of a step onto the invariants, by less than the step's error, and returns the
  /// rate there. The rate is used for the error estimate and the next step.
  std::function<void(double time_s, Vector& y, Vector& rate)> finish_step;
  /// @param error  estimated error of y_end, in the units of y
  std::function<ErrorEstimate(const Vector& y_begin, const Vector& y_end, const Vector& error)>
      measure;
  std::function<std::string(std::size_t component)> name_of_component;
  /// The loads, as derivative() evaluated them last: steps end at their kinks. Null if all are
  /// smooth.
  const ForceSet* forces = nullptr;
};

/// The explicit pair of orders 5(4) by Dormand and Prince (J. Comp. Appl. Math. 6, 1980) with
/// Shampine's dense output of order 4 and PI step control (Hairer, Norsett and Wanner, Solving
/// Ordinary Differential Equations I, II.4 to II.6).
class DormandPrince final : public TimeIntegrator {
 public:
  /// @param y  state at `time_s`
  DormandPrince(InitialValueProblem problem, StepLimits limits, double time_s, const Vector& y);

  void restart() override;
  Pace pace() const override { return {proposed_s_, last_error_}; }
  void set_pace(const Pace& pace) override {
    proposed_s_ = pace.proposed_s;
    last_error_ = pace.error;
  }
  void step(double limit_s) override;
  /// Takes a step of the given length, whatever its error.
  void fixed_step(double length_s);
  void interpolate(double time_s, Vector& y) const override;
  std::string name_of(std::size_t component) const override {
    return problem_.name_of_component(component);
  }
  std::string name_of_event(std::size_t event) const override {
    return problem_.forces->name_of_piece(event);
  }

 private:
  static constexpr int kStages = 7;

  void attempt(double length_s);
  ErrorEstimate tried(double length_s);
  void make_dense(double length_s);
  void accept(double length_s);
  double choose_first_step() const;
  void begin_motion();
  /// The fraction of the tried step at which the first kink of a load lies; 1 if none lies before
  /// the step's end.
  double share_to_event(double length_s);
  void interpolate_at(double s, Vector& y) const;
  double adapted(double length_s, double error);

  InitialValueProblem problem_;
  double previous_time_s_;
  Vector y_next_, y_stage_, error_;
  std::array<Vector, kStages> rates_;
  std::array<Vector, 5> dense_;
  std::optional<EventSearch> events_;
  double proposed_s_ = 0;  ///< zero: not yet chosen
  double last_error_ = 1e-4;
  bool fresh_ = false;  ///< rates_[0] belongs to the present state
};

}  // namespace flexneck::multibody
