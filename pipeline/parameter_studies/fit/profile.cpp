// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/fit/profile.h"

#include <algorithm>
#include <cmath>

#include "pipeline/parameter_studies/fit/identifiability.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Relative tolerance of the increase of chi-squared at the end of the interval.
constexpr double kClose = 0.02;
constexpr int kMostPoints = 12;  ///< maximum number on either side

class Walk {
 public:
  Walk(const FitObjective& objective, const Minimum& minimum, Index parameter, FitSearch search,
       Profile& profile)
      : objective_(objective),
        minimum_(minimum),
        parameter_(parameter),
        search_(std::move(search)),
        profile_(profile),
        more_(chi_squared_quantile(0.95, 1)) {
    search_.is_held.assign(static_cast<std::size_t>(objective.parameter_count()), false);
    search_.is_held[static_cast<std::size_t>(parameter)] = true;
  }

  /// Walks to one side.
  /// @param step  the first step, with its sign
  /// @return the place where chi-squared has increased by 3.84
  std::optional<double> operator()(double step) {
    others_ = minimum_.place;
    const double bound = step > 0 ? 1 : 0;
    double inner = minimum_.place[parameter_];
    double inner_excess = 0;
    for (int k = 0; k < kMostPoints; ++k, step *= 2) {
      const double outer = std::clamp(inner + step, 0.0, 1.0);
      if (outer == inner) return std::nullopt;
      const double outer_excess = excess_at(outer);
      if (outer_excess >= more_) return between(inner, inner_excess, outer, outer_excess);
      if (outer == bound) return std::nullopt;
      inner = outer;
      inner_excess = outer_excess;
    }
    return std::nullopt;
  }

 private:
  double excess_at(double place) {
    VectorXd start = others_;
    start[parameter_] = place;
    const Minimum found = least_squares(objective_, start, search_);
    if (found.has_failed()) return std::numeric_limits<double>::infinity();
    others_ = found.place;
    profile_.points.push_back({place, found.chi_squared});
    constexpr double kBetter = 1e-3;
    if (found.chi_squared < minimum_.chi_squared - kBetter &&
        (!profile_.better || found.chi_squared < profile_.better->chi_squared))
      profile_.better = found;
    return found.chi_squared - minimum_.chi_squared;
  }

  /// Finds the end of the interval for the root of the excess, which is quadratic, by regula falsi,
  /// and by bisection if the outer place has failed.
  double between(double inner, double inner_excess, double outer, double outer_excess) {
    const auto root = [](double excess) { return std::sqrt(std::max(excess, 0.0)); };
    for (int k = 0; k < kMostPoints; ++k) {
      double share = 0.5;
      if (std::isfinite(outer_excess))
        share = (root(more_) - root(inner_excess)) / (root(outer_excess) - root(inner_excess));
      const double place = inner + std::clamp(share, 0.05, 0.95) * (outer - inner);
      const double excess = excess_at(place);
      if (std::abs(excess - more_) < kClose * more_) return place;
      (excess < more_ ? inner : outer) = place;
      (excess < more_ ? inner_excess : outer_excess) = excess;
    }
    return 0.5 * (inner + outer);
  }

  const FitObjective& objective_;
  const Minimum& minimum_;
  Index parameter_;
  FitSearch search_;
  Profile& profile_;
  double more_;
  VectorXd others_;  ///< last values of the other parameters
};

}  // namespace

Profile profile_of(const FitObjective& objective, const Minimum& minimum, Index parameter,
                   double deviation, const FitSearch& search) {
  constexpr double kLeastStep = 1e-6;
  constexpr double kLargestStep = 0.125;
  Profile profile;
  profile.points.push_back({minimum.place[parameter], minimum.chi_squared});
  const double step = std::clamp(2 * deviation, kLeastStep, kLargestStep);
  Walk walk(objective, minimum, parameter, search, profile);
  profile.low = walk(-step);
  profile.high = walk(step);
  std::sort(profile.points.begin(), profile.points.end(),
            [](const auto& a, const auto& b) { return a.place < b.place; });
  return profile;
}

}  // namespace flexneck::pipeline
