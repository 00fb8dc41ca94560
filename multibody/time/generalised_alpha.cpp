// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/time/generalised_alpha.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int kMaxIterations = 8;
/// Newton's method stops at this fraction of the positions' tolerance, and is given up if a
/// correction is not smaller than this fraction of the last. Velocities are not checked: over a
/// short step the rounding of the constraints exceeds a tight tolerance in them (equations.md
/// section 9).
constexpr double kConverged = 1e-3;
constexpr double kSlow = 0.6;
/// Factor by which a step is shortened if it does not converge.
constexpr double kCut = 0.25;
/// Fraction of the step that would have passed a kink, up to which the kink is approached; a short
/// step then passes it: the load has hardly changed there, and the short step's error by the kink
/// is of second order in its length.
constexpr double kClose = 1e-4;
/// Fraction of a step for the finite difference that estimates V'' after a restart.
constexpr double kDifference = 1e-3;

// Step control. The local error is of order 3. Within the dead band the step is kept, and with it
// the factors of Newton's matrix.
constexpr double kSafety = 0.9;
constexpr double kLargestGrowth = 2;
constexpr double kLargestCut = 0.2;
constexpr double kDeadBand = 1.2;

}  // namespace

AlphaParameters::AlphaParameters(double spectral_radius)
    : alpha_m((2 * spectral_radius - 1) / (spectral_radius + 1)),
      alpha_f(spectral_radius / (spectral_radius + 1)),
      gamma(0.5 + alpha_f - alpha_m),
      beta(0.25 * (gamma + 0.5) * (gamma + 0.5)),
      shift(alpha_m - alpha_f),
      quotient((1 - alpha_f) / (1 - alpha_m)),
      error(beta + shift / 2 - 1. / 6) {}

GeneralisedAlpha::GeneralisedAlpha(Equations& equations, double spectral_radius, StepLimits limits,
                                   double time_s, const Vector& y)
    : TimeIntegrator(limits, time_s, y),
      equations_(equations),
      alpha_(spectral_radius),
      nq_(equations.layout().positions),
      nv_(equations.layout().velocities),
      ni_(equations.layout().internal),
      nc_(equations.layout().constraints),
      matrix_(equations, y.size()),
      now_{Vector::Zero(nv_), Vector::Zero(nc_), Vector::Zero(nv_)},
      next_(now_),
      before_(now_),
      offset_rate_(Vector::Zero(nv_)),
      displacement_(Vector::Zero(nv_)),
      displacement_before_(Vector::Zero(nv_)),
      moved_(Vector::Zero(nv_)),
      residual_(Vector::Zero(nv_ + nc_)),
      change_(Vector::Zero(nv_)),
      error_(Vector::Zero(y.size())),
      y_next_(y),
      y_before_(y),
      y_trial_(y),
      rate_(Vector::Zero(y.size())),
      rate_next_(rate_),
      rate_before_(rate_),
      rate_trial_(rate_),
      previous_time_s_(time_s),
      events_(equations.forces()) {}

/// Computes consistent V' and multipliers after a jump, and V'' by a finite difference along the
/// motion, without which a_n would be of first order only. A length of zero denotes the start of a
/// run.
void GeneralisedAlpha::begin(double length_s) {
  equations_.derivative(time_s_, y_, rate_);
  equations_.finish_step(time_s_, y_, rate_);
  watch_from_here();
  events_.start();
  now_.V_rate = rate_.segment(nq_, nv_);
  now_.lambda = equations_.multipliers();
  if (!(rate_.allFinite() && y_.allFinite())) collapse(equations_.measure(y_, y_, rate_));
  if (length_s == 0) length_s = proposed_s_ = first_step();
  const double ahead = kDifference * length_s;
  y_trial_ = y_ + ahead * rate_;
  equations_.derivative(time_s_ + ahead, y_trial_, rate_next_);
  offset_rate_ = (alpha_.shift / ahead) * (rate_next_.segment(nq_, nv_) - now_.V_rate);
  last_length_s_ = 0;
  fresh_ = true;
}

double GeneralisedAlpha::first_step() const {
  const double rate = equations_.measure(y_, y_, rate_).value;
  const double length = rate > 0 ? 1e-1 * std::pow(rate, -1. / 3) : limits_.largest_s;
  return std::clamp(length, limits_.smallest_s, limits_.largest_s);
}

/// Linearises about the predicted end of a step: on the way there the joints may have passed a
/// singular configuration, on whose other side the rows of the beginning lead away.
void GeneralisedAlpha::linearise(double length_s) {
  predict(length_s);
  update_end(length_s);
  matrix_.linearise(equations_, time_s_ + length_s, y_next_, next_.V_rate, next_.lambda);
  linearised_ = true;
  factorised_for_s_ = 0;
  ++linearisations_;
}

bool GeneralisedAlpha::attempt(double length_s) {
  now_.a = now_.V_rate + length_s * offset_rate_;
  equations_.begin_step(y_, rate_, length_s);
  events_.begin_step();
  const bool first = !linearised_;
  if (first) linearise(length_s);
  const auto succeeds = [&] {
    if (!iterate(length_s)) return false;
    events_.see_end();
    if (!matrix_.leaves_out_only_redundant(equations_, time_s_ + length_s, y_next_)) return false;
    equations_.rate(y_next_, next_.V_rate, rate_next_);
    return true;
  };
  if (succeeds()) return true;
  if (first) return false;
  linearise(length_s);
  return succeeds();
}

void GeneralisedAlpha::predict(double length_s) {
  next_.V_rate = now_.V_rate;
  next_.lambda = now_.lambda;
  if (last_length_s_ == 0) return;
  const double ratio = length_s / last_length_s_;
  next_.V_rate += ratio * (now_.V_rate - before_.V_rate);
  next_.lambda += ratio * (now_.lambda - before_.lambda);
}

/// Computes the end of the step for the V' there.
void GeneralisedAlpha::update_end(double length_s) {
  const double h = length_s;
  next_.a = alpha_.quotient * next_.V_rate +
            (alpha_.alpha_f * now_.V_rate - alpha_.alpha_m * now_.a) / (1 - alpha_.alpha_m);
  const auto V = y_.segment(nq_, nv_);
  displacement_ = h * V + h * h * ((0.5 - alpha_.beta) * now_.a + alpha_.beta * next_.a);
  y_next_.head(nq_) = y_.head(nq_);
  equations_.retract(y_next_.head(nq_), displacement_);
  y_next_.segment(nq_, nv_) = V + h * ((1 - alpha_.gamma) * now_.a + alpha_.gamma * next_.a);
}

ErrorEstimate GeneralisedAlpha::size_of(const Vector& d, double q) {
  change_ = q * d.head(nv_);
  y_trial_.head(nq_) = y_next_.head(nq_);
  equations_.retract(y_trial_.head(nq_), change_);
  error_.head(nq_) = y_trial_.head(nq_) - y_next_.head(nq_);
  return equations_.measure(y_, y_next_, error_);
}

bool GeneralisedAlpha::iterate(double length_s) {
  const double q = alpha_.quotient * alpha_.beta * length_s * length_s;
  const double v = alpha_.quotient * alpha_.gamma * length_s;
  if (factorised_for_s_ != length_s) matrix_.factorise(q, v);
  factorised_for_s_ = length_s;
  predict(length_s);
  double last_size = 0;
  for (int k = 0; k < kMaxIterations; ++k) {
    update_end(length_s);
    equations_.residual(time_s_ + length_s, y_next_, next_.V_rate, next_.lambda, residual_);
    matrix_.solve(residual_);
    next_.V_rate += residual_.head(nv_);
    next_.lambda += residual_.tail(nc_);
    const ErrorEstimate size = size_of(residual_, q);
    if (!std::isfinite(size.value)) {
      last_estimate_ = size;
      return false;
    }
    // The remaining corrections form a geometric series.
    const double ratio = k == 0 ? kSlow : size.value / last_size;
    const double left = ratio < 1 ? size.value * ratio / (1 - ratio) : size.value;
    if (left <= kConverged) {
      update_end(length_s);
      y_next_.segment(nq_ + nv_, ni_) = equations_.forces().internal();
      return true;
    }
    if (k > 0 && ratio > kSlow) return false;
    last_size = size.value;
  }
  return false;
}

ErrorEstimate GeneralisedAlpha::local_error(double length_s) {
  residual_.head(nv_) = (alpha_.error * length_s * length_s) * (next_.a - now_.a);
  if (!met_stop_) {
    change_ = residual_.head(nv_);
    matrix_.filter(change_);
    residual_.head(nv_) = change_;
  }
  return size_of(residual_, 1);
}

bool GeneralisedAlpha::tried(double length_s) {
  if (!attempt(length_s)) return false;
  last_estimate_ = local_error(length_s);
  return true;
}

bool GeneralisedAlpha::try_step(double& length_s) {
  crosses_ = false;
  if (!tried(length_s)) return false;
  if (!(last_estimate_.value <= 1) || events_.is_idle()) return true;
  const bool is_left = events_.is_left();
  const double share = is_left ? share_on_prediction(length_s) : share_inside(length_s);
  if (!is_left && share == 1) {
    approached_from_s_ = 0;
    return true;
  }
  reason_ = StepReason::event;
  event_ = events_.event();
  if (approached_from_s_ == 0) approached_from_s_ = length_s;
  const double ahead_s = share * length_s;
  crosses_ = ahead_s <= kClose * approached_from_s_;
  if (crosses_) {
    length_s = std::min(length_s, 2 * ahead_s);
    return tried(length_s);
  }
  // Stop so far before the kink that it lies inside the next step.
  length_s = ahead_s - kClose / 2 * approached_from_s_;
  for (double back = kClose;; back = std::min(10 * back, 0.5)) {
    length_s *= 1 - back;
    if (!tried(length_s)) return false;
    crosses_ = length_s <= kClose * approached_from_s_;
    if (!(last_estimate_.value <= 1) || crosses_ || !events_.is_left()) return true;
  }
}

double GeneralisedAlpha::share_inside(double length_s) {
  if (last_length_s_ > 0) events_.see_step_before(-last_length_s_ / length_s);
  const auto evaluate = [&](double share) {
    interpolate_between({y_, rate_, y_next_, rate_next_, displacement_, length_s}, share, y_trial_);
    equations_.derivative(time_s_ + share * length_s, y_trial_, rate_trial_);
  };
  const double share = events_.first_event(std::cref(evaluate));
  // Evaluate the loads at the step's end again, as they were before the search.
  if (share == 1 && events_.evaluations() > 0)
    equations_.derivative(time_s_ + length_s, y_next_, rate_trial_);
  return share;
}

/// The fraction at which a kink is reached along the predicted step without the kink: the computed
/// end, which obeys the law behind the kink, does not show when that law began.
double GeneralisedAlpha::share_on_prediction(double length_s) {
  const auto evaluate = [&](double share) {
    const double h = share * length_s;
    now_.a = now_.V_rate + h * offset_rate_;
    predict(h);
    update_end(h);
    equations_.derivative(time_s_ + h, y_next_, rate_trial_);
  };
  evaluate(1);
  events_.see_end();
  return events_.first_event(std::cref(evaluate));
}

void GeneralisedAlpha::accept(double length_s) {
  events_.accept();
  y_next_.tail<2>() = y_.tail<2>() + length_s / 2 * (rate_.tail<2>() + rate_next_.tail<2>());
  offset_rate_ = (next_.a - next_.V_rate) / length_s;
  displacement_before_.swap(displacement_);
  std::swap(before_, now_);
  std::swap(now_, next_);
  y_before_.swap(y_);
  y_.swap(y_next_);
  rate_before_.swap(rate_);
  rate_.swap(rate_next_);
  previous_time_s_ = time_s_;
  time_s_ += length_s;
  last_length_s_ = length_s;
  ++accepted_;
}

void GeneralisedAlpha::give_up(double length_s) const {
  constexpr int kDigits = 9;
  throw ComputationError("Newton's method does not converge over a step of " +
                         rounded_text(length_s, kDigits) + " s at " +
                         rounded_text(time_s_, kDigits) + " s");
}

void GeneralisedAlpha::fixed_step(double length_s) {
  if (!fresh_) begin(length_s);
  if (!attempt(length_s)) give_up(length_s);
  accept(length_s);
}

void GeneralisedAlpha::step(double limit_s) {
  if (!fresh_) begin(proposed_s_);
  const double left = limit_s - time_s_;
  bool rejected_before = false;
  bool failed_before = false;
  bool blind_before = false;
  while (true) {
    if (proposed_s_ < limits_.smallest_s && failed_before) give_up(limits_.smallest_s);
    if (proposed_s_ < limits_.smallest_s) collapse(last_estimate_);
    double length = std::min(proposed_s_, limits_.largest_s);
    reason_ = length < proposed_s_ ? StepReason::largest_step : StepReason::error;
    if (blind_before) reason_ = StepReason::load;
    if (failed_before) reason_ = StepReason::iteration;
    if (length >= left * (1 - 1e-9)) {
      length = left;
      reason_ = StepReason::end;
    }
    if (!try_step(length)) {
      ++rejected_;
      rejected_before = failed_before = true;
      proposed_s_ = kCut * length;
      continue;
    }
    const double error = last_estimate_.value;
    const double factor = kSafety * std::pow(std::max(error, 1e-9), -1. / 3);
    const double seen = error <= 1 ? share_seen(length, LoadWatch::Method::ends) : 1;
    if (seen < 1) {
      ++rejected_;
      rejected_before = blind_before = true;
      failed_before = false;
      proposed_s_ = seen * length;
      continue;
    }
    if (error <= 1) {
      double next = length * std::min(factor, kLargestGrowth);
      if (rejected_before) next = std::min(next, length);
      if (factor >= 1 && factor < kDeadBand) next = length;
      // A step shortened by the limit or an event is no reason to reduce the proposed length.
      const bool at_event = reason_ == StepReason::event;
      const bool at_end = reason_ == StepReason::end;
      proposed_s_ = at_event || at_end ? std::max(next, proposed_s_) : next;
      accept(length);
      watch_from_end();
      if (at_end) time_s_ = limit_s;
      // But a step as long as a short contact would have the same accelerations at both ends.
      if (crosses_) proposed_s_ = std::min(proposed_s_, first_step());
      if (crosses_) approached_from_s_ = 0;
      // After a jump, a, which lags behind V', would propagate it from step to step.
      const bool passed_jump = reason_ == StepReason::load && watch_->is_blind_to(length);
      if (crosses_ || passed_jump) fresh_ = false;
      met_stop_ = crosses_ && ForceSet::is_deflection(event_);
      return;
    }
    ++rejected_;
    rejected_before = true;
    failed_before = blind_before = false;
    proposed_s_ = length * (std::isfinite(error) ? std::max(factor, kLargestCut) : kLargestCut);
  }
}

void GeneralisedAlpha::interpolate(double time_s, Vector& y) const {
  const double h = time_s_ - previous_time_s_;
  interpolate_between({y_before_, rate_before_, y_, rate_, displacement_before_, h},
                      h > 0 ? (time_s - previous_time_s_) / h : 0, y);
}

/// Interpolates by Hermite's cubic.
void GeneralisedAlpha::interpolate_between(const Step& step, double share, Vector& y) const {
  const double h = step.length_s;
  const double s = share;
  const double r = 1 - s;
  y = r * step.y_begin + s * step.y_end -
      (s * r) * ((1 - 2 * s) * (step.y_end - step.y_begin) + (s * h) * step.rate_end -
                 (r * h) * step.rate_begin);
  moved_ = s * step.displacement -
           (s * r) * ((1 - 2 * s) * step.displacement + (s * h) * step.y_end.segment(nq_, nv_) -
                      (r * h) * step.y_begin.segment(nq_, nv_));
  y.head(nq_) = step.y_begin.head(nq_);
  equations_.retract(y.head(nq_), moved_);
}

}  // namespace flexneck::multibody
