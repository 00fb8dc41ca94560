// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/fit/limited_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double kFirstDeviation = 0.1;  ///< fraction of the smoothing
/// Fraction of the smoothing by which the edges are moved inwards: the limit of the iteration, on
/// the moved edge, then lies inside the window.
constexpr double kInset = 1e-3;

/// A window that is a constraint.
class Limit {
 public:
  Limit(const FitTerm& term, std::size_t place) : term_(term), place_(place) {}

  /// The window as an ordinary term, with its edges shifted.
  FitTerm counted(double deviation) const {
    FitTerm term = term_;
    term.must_hold = false;
    term.deviation = deviation * term_.deviation;
    term.window = FitTerm::Window{low() + low_shift_, high() - high_shift_};
    return term;
  }
  /// Updates the multipliers for the observables.
  void move(const VectorXd& values) {
    low_shift_ = std::max(0.0, low_shift_ + low() - value(values));
    high_shift_ = std::max(0.0, high_shift_ + value(values) - high());
  }
  /// Converts the shifts to another deviation: the multiplier is the shift over its square.
  void rescale(double ratio) {
    low_shift_ *= ratio * ratio;
    high_shift_ *= ratio * ratio;
  }
  bool is_met(const VectorXd& values) const { return term_.is_met(value(values), 0); }
  /// Complementarity error, in smoothings: distance from an edge with a multiplier or a violation.
  double slack(const VectorXd& values) const {
    return std::max(std::abs(std::min(low_shift_, value(values) - low())),
                    std::abs(std::min(high_shift_, high() - value(values)))) /
           term_.deviation;
  }
  std::size_t place() const { return place_; }
  const std::string& target() const { return term_.target; }

 private:
  double low() const { return term_.window->low + kInset * term_.deviation; }
  double high() const { return term_.window->high - kInset * term_.deviation; }
  double value(const VectorXd& values) const { return values[static_cast<Index>(place_)]; }

  const FitTerm& term_;
  std::size_t place_;
  double low_shift_ = 0;
  double high_shift_ = 0;
};

std::vector<Limit> limits_of(const FitObjective& objective) {
  std::vector<Limit> limits;
  for (std::size_t k = 0; k < objective.terms().size(); ++k)
    if (objective.terms()[k].must_hold) limits.emplace_back(objective.terms()[k], k);
  return limits;
}

FitObjective counted(const FitObjective& objective, const std::vector<Limit>& limits,
                     double deviation) {
  std::vector<FitTerm> terms = objective.terms();
  for (const Limit& each : limits) terms[each.place()] = each.counted(deviation);
  return {objective.ranges(), std::move(terms), objective.model()};
}

}  // namespace

FitObjective with_limits_as_windows(const FitObjective& objective) {
  return counted(objective, limits_of(objective), kFirstDeviation);
}

Minimum least_squares_within_limits(const FitObjective& objective, const VectorXd& start,
                                    const FitSearch& search) {
  constexpr int kMostRounds = 12;
  constexpr double kSharper = 0.5;  // factor on the deviation from one round to the next
  std::vector<Limit> limits = limits_of(objective);
  Minimum found;
  found.place = start;
  int evaluations = 0;
  double deviation = kFirstDeviation;
  bool is_settled = false;
  for (int round = 0; round < kMostRounds && !is_settled; ++round, deviation *= kSharper) {
    found = least_squares(counted(objective, limits, deviation), found.place, search);
    evaluations += found.evaluations;
    if (found.has_failed()) break;
    is_settled = true;
    for (Limit& each : limits) {
      is_settled = is_settled && each.is_met(found.values) && each.slack(found.values) < kInset;
      each.move(found.values);
      each.rescale(kSharper);
    }
  }
  found.evaluations = evaluations;
  if (found.has_failed()) return found;
  found.chi_squared = objective.residuals(found.place, found.values).squaredNorm();
  found.has_converged = found.has_converged && is_settled;
  for (const Limit& each : limits)
    if (!each.is_met(found.values))
      found.problem = "no point was found at which '" + each.target() + "' is inside its window";
  return found;
}

}  // namespace flexneck::pipeline
