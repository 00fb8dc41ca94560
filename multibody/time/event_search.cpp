// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/time/event_search.h"

#include <algorithm>
#include <cmath>

namespace flexneck::multibody {
namespace {

/// Fraction of the step up to which an event counts as the one at which the last step ended.
constexpr double kAtBeginning = 1e-6;
/// Bound of a coordinate's deviation from its chord, as a multiple of the parabola through a point:
/// a factor of two would suffice for the cubics through three points.
constexpr double kSwing = 3;
/// Distance beyond a kink that is only rounding, in m, rad or per s, or relative to the coordinate.
constexpr double kRounding = 1e-12;
/// Largest number of evaluations of one search. A grazing kink takes a hundred to rounding; more
/// are due to noise at a kink.
constexpr int kMostEvaluations = 400;

constexpr double kNone = 2;  ///< larger than all fractions

}  // namespace

EventSearch::EventSearch(const ForceSet& forces) : forces_(forces) {
  for (Sample* const sample : {&before_, &begin_, &end_}) sample->take(forces);
  for (Point& point : points_) point.kinks = forces.kinks();
  middles_.assign(kMaxLevel, begin_);
  swings_.assign(kMaxLevel + 1, std::vector<double>(forces.kinks().size(), 0));
}

void EventSearch::start() {
  begin_.take(forces_);
  has_before_ = false;
}

void EventSearch::see(double share, const std::vector<KinksAround>& kinks) {
  Point& point = points_[seen_++];
  point.share = share;
  point.kinks = kinks;
}

void EventSearch::see_step_before(double share) {
  if (has_before_) see(share, before_.kinks);
}

void EventSearch::accept() {
  std::swap(before_, begin_);
  std::swap(begin_, end_);
  has_before_ = true;
}

void EventSearch::bound_by_points() {
  std::vector<double>& swings = swings_.front();
  std::fill(swings.begin(), swings.end(), 0);
  for (std::size_t p = 0; p < seen_; ++p) {
    const double s = points_[p].share;
    // Parabola 4 D s (1 - s) above the chord.
    const double factor = kSwing / (4 * std::abs(s * (1 - s)));
    for (std::size_t k = 0; k < swings.size(); ++k) {
      const double chord = (1 - s) * begin_.kinks[k].at + s * end_.kinks[k].at;
      swings[k] = std::max(swings[k], factor * std::abs(points_[p].kinks[k].at - chord));
    }
  }
}

bool EventSearch::may_leave(const Span& span, int level) const {
  if (evaluations_ > kMostEvaluations) return false;
  const std::vector<double>& swings = swings_[static_cast<std::size_t>(level)];
  for (std::size_t k = 0; k < swings.size(); ++k) {
    const KinksAround& kinks = begin_.kinks[k];
    const auto [lower, upper] = std::minmax(span.at_begin.kinks[k].at, span.at_end.kinks[k].at);
    const double rounding = kRounding * std::max(1.0, std::abs(kinks.at));
    const double reach = swings[k] - rounding;
    if (lower - reach < kinks.low || upper + reach > kinks.high) return true;
  }
  return false;
}

double EventSearch::first_departure(const Span& span, int level, const Evaluate& evaluate) {
  const bool leaves = span.at_end.pieces != begin_.pieces;
  if (!leaves && !may_leave(span, level)) return kNone;
  if (level == kMaxLevel) {
    if (!leaves) return kNone;
    const auto found = std::ranges::mismatch(begin_.pieces, span.at_end.pieces).in1;
    event_ = static_cast<std::size_t>(found - begin_.pieces.begin());
    return span.end;
  }
  const double middle = (span.begin + span.end) / 2;
  evaluate(middle);
  ++evaluations_;
  const auto at = static_cast<std::size_t>(level);
  Sample& here = middles_[at];
  here.take(forces_);
  // A half deviates by a quarter of the parabola, and by an eighth of the rest for higher orders.
  std::vector<double>& swings = swings_[at + 1];
  for (std::size_t k = 0; k < swings.size(); ++k) {
    const double chord = (span.at_begin.kinks[k].at + span.at_end.kinks[k].at) / 2;
    swings[k] = kSwing / 4 * std::abs(here.kinks[k].at - chord) + swings_[at][k] / 8;
  }
  const double first =
      first_departure({span.begin, span.at_begin, middle, here}, level + 1, evaluate);
  if (first != kNone) return first;
  return first_departure({middle, here, span.end, span.at_end}, level + 1, evaluate);
}

double EventSearch::first_event(const Evaluate& evaluate) {
  evaluations_ = 0;
  if (is_idle()) return 1;
  if (seen_ == 0) {
    evaluate(0.5);
    ++evaluations_;
    see(0.5);
  }
  bound_by_points();
  double found = first_departure({0, begin_, 1, end_}, 0, evaluate);
  if (found <= kAtBeginning) {
    // The last step ended at this kink, so this step is on the piece behind it.
    evaluate(kAtBeginning);
    ++evaluations_;
    begin_.take(forces_);
    bound_by_points();
    found = first_departure({kAtBeginning, begin_, 1, end_}, 0, evaluate);
  }
  return std::min(found, 1.0);
}

}  // namespace flexneck::multibody
