// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/time/dormand_prince.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace flexneck::multibody {
namespace {

using Row = std::array<double, 6>;

constexpr std::array<double, 6> kTimes = {0, 1. / 5, 3. / 10, 4. / 5, 8. / 9, 1};
/// Weights of the stages: row i gives stage i + 1; the last is the step itself (order 5).
constexpr std::array<Row, 6> kStageWeights = {
    {{1. / 5},
     {3. / 40, 9. / 40},
     {44. / 45, -56. / 15, 32. / 9},
     {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
     {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
     {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84}}};
/// Weights of the error: those of order 5 minus those of order 4.
constexpr std::array<double, 7> kErrorWeights = {
    71. / 57600, 0, -71. / 16695, 71. / 1920, -17253. / 339200, 22. / 525, -1. / 40};
constexpr std::array<double, 7> kDenseWeights = {
    -12715105075. / 11282082432.,  0,
    87487479700. / 32700410799.,   -10690763975. / 1880347072.,
    701980252875. / 199316789632., -1453857185. / 822651844.,
    69997945. / 29380423.};

// Step control, Hairer et al. II.4: h <- h safety err^-alpha err_before^beta, within bounds.
constexpr double kSafety = 0.9;
constexpr double kBeta = 0.04;
constexpr double kAlpha = 0.2 - 0.75 * kBeta;
constexpr double kLargestGrowth = 10;
constexpr double kLargestCut = 0.2;

}  // namespace

DormandPrince::DormandPrince(InitialValueProblem problem, StepLimits limits, double time_s,
                             const Vector& y)
    : TimeIntegrator(limits, time_s, y),
      problem_(std::move(problem)),
      previous_time_s_(time_s),
      y_next_(y),
      y_stage_(y),
      error_(Vector::Zero(y.size())) {
  for (Vector& rate : rates_) rate.setZero(y.size());
  for (Vector& coefficients : dense_) coefficients.setZero(y.size());
  dense_[0] = y;
  if (problem_.forces != nullptr && !problem_.forces->pieces().empty())
    events_.emplace(*problem_.forces);
}

void DormandPrince::restart() { fresh_ = false; }

void DormandPrince::begin_motion() {
  problem_.derivative(time_s_, y_, rates_[0]);
  if (events_) events_->start();
  watch_from_here();
  fresh_ = true;
}

void DormandPrince::attempt(double length_s) {
  if (events_) events_->begin_step();
  for (std::size_t stage = 1; stage < kStages; ++stage) {
    Vector& target = stage < kStages - 1 ? y_stage_ : y_next_;
    target = y_;
    for (std::size_t k = 0; k < stage; ++k) {
      const double weight = kStageWeights[stage - 1][k];
      if (weight != 0) target += length_s * weight * rates_[k];
    }
    if (stage == kStages - 1) continue;
    problem_.derivative(time_s_ + kTimes[stage] * length_s, target, rates_[stage]);
    if (events_ && kTimes[stage] < 1) events_->see(kTimes[stage]);
  }
  problem_.finish_step(time_s_ + length_s, y_next_, rates_[kStages - 1]);
  if (events_) events_->see_end();
  error_.setZero();
  for (std::size_t k = 0; k < kStages; ++k)
    if (kErrorWeights[k] != 0) error_ += length_s * kErrorWeights[k] * rates_[k];
}

/// Dense output, Hairer et al. II.6: CONTD5.
void DormandPrince::make_dense(double length_s) {
  dense_[0] = y_;
  dense_[1] = y_next_ - y_;
  dense_[2] = length_s * rates_[0] - dense_[1];
  dense_[3] = dense_[1] - length_s * rates_[6] - dense_[2];
  dense_[4].setZero();
  for (std::size_t k = 0; k < kStages; ++k)
    if (kDenseWeights[k] != 0) dense_[4] += length_s * kDenseWeights[k] * rates_[k];
}

void DormandPrince::accept(double length_s) {
  make_dense(length_s);
  previous_time_s_ = time_s_;
  time_s_ += length_s;
  y_.swap(y_next_);
  rates_.front().swap(rates_.back());
  if (events_) events_->accept();
  ++accepted_;
}

void DormandPrince::interpolate(double time_s, Vector& y) const {
  const double length = time_s_ - previous_time_s_;
  interpolate_at(length > 0 ? (time_s - previous_time_s_) / length : 0, y);
}

void DormandPrince::interpolate_at(double s, Vector& y) const {
  const double r = 1 - s;
  y = dense_[0] + s * (dense_[1] + r * (dense_[2] + s * (dense_[3] + r * dense_[4])));
}

double DormandPrince::share_to_event(double length_s) {
  if (!events_) return 1;
  const auto evaluate = [&](double share) {
    if (events_->evaluations() == 0) make_dense(length_s);
    interpolate_at(share, y_stage_);
    problem_.derivative(time_s_ + share * length_s, y_stage_, rates_[1]);
  };
  const double share = events_->first_event(std::cref(evaluate));
  event_ = events_->event();
  // Evaluate the loads at the step's end again, as they were before the search.
  if (share == 1 && events_->evaluations() > 0)
    problem_.derivative(time_s_ + length_s, y_next_, rates_[1]);
  return share;
}

void DormandPrince::fixed_step(double length_s) {
  if (!fresh_) begin_motion();
  attempt(length_s);
  accept(length_s);
}

double DormandPrince::choose_first_step() const {
  // h = 1e-2 r^(-1/5), with r the present rate in units of the tolerance: cautious, since the
  // control can increase it tenfold per step.
  const double rate = problem_.measure(y_, y_, rates_[0]).value;
  const double length = rate > 0 ? 1e-2 * std::pow(rate, -0.2) : limits_.largest_s;
  return std::clamp(length, limits_.smallest_s, limits_.largest_s);
}

double DormandPrince::adapted(double length_s, double error) {
  const double factor = std::pow(error, kAlpha) / (std::pow(last_error_, kBeta) * kSafety);
  return length_s / std::clamp(factor, 1 / kLargestGrowth, 1 / kLargestCut);
}

ErrorEstimate DormandPrince::tried(double length_s) {
  attempt(length_s);
  last_estimate_ = problem_.measure(y_, y_next_, error_);
  return last_estimate_;
}

void DormandPrince::step(double limit_s) {
  if (!fresh_) begin_motion();
  if (!(rates_[0].allFinite() && y_.allFinite())) collapse(problem_.measure(y_, y_, rates_[0]));
  if (proposed_s_ == 0) proposed_s_ = choose_first_step();
  const double left = limit_s - time_s_;
  bool rejected_before = false;
  bool blind_before = false;
  while (true) {
    if (proposed_s_ < limits_.smallest_s) collapse(last_estimate_);
    double length = std::min(proposed_s_, limits_.largest_s);
    reason_ = length < proposed_s_ ? StepReason::largest_step : StepReason::error;
    if (blind_before) reason_ = StepReason::load;
    bool truncated = length >= left * (1 - 1e-9);
    if (truncated) {
      length = left;
      reason_ = StepReason::end;
    }
    ErrorEstimate error = tried(length);
    const double seen = error.value <= 1 ? share_seen(length, LoadWatch::Method::six_stages) : 1;
    if (seen < 1) {
      ++rejected_;
      rejected_before = blind_before = true;
      proposed_s_ = seen * length;
      continue;
    }
    const double share = error.value <= 1 ? share_to_event(length) : 1;
    if (share < 1) {
      length *= share;
      reason_ = StepReason::event;
      truncated = false;
      error = tried(length);
      share_seen(length, LoadWatch::Method::six_stages);  // this records the motion at its end
    }
    if (error.value <= 1) {
      double next = adapted(length, error.value);
      if (rejected_before) next = std::min(next, length);
      // A step shortened by the limit or an event is no reason to reduce the proposed length.
      proposed_s_ = truncated || share < 1 ? std::max(next, proposed_s_) : next;
      last_error_ = std::max(error.value, 1e-4);
      accept(length);
      watch_from_end();
      if (truncated) time_s_ = limit_s;
      return;
    }
    ++rejected_;
    rejected_before = true;
    blind_before = false;
    const double cut = std::pow(error.value, -kAlpha) * kSafety;
    proposed_s_ = length * (std::isfinite(error.value) ? std::max(cut, kLargestCut) : kLargestCut);
  }
}

}  // namespace flexneck::multibody
