// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/fit/fit_objective.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "geometry/foundation/in_parallel.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Two steps of a parameter: one to each side, or one and two to the same side at a bound.
std::pair<double, double> steps_of(const FitRange& range, double at, double step) {
  if (at - step < range.from) return {step, 2 * step};
  if (at + step > range.to) return {-step, -2 * step};
  return {-step, step};
}

}  // namespace

double FitTerm::residual(double observed) const {
  if (!window) return (observed - value) / deviation;
  if (observed > window->high) return (observed - window->high) / deviation;
  if (observed < window->low) return (observed - window->low) / deviation;
  return 0;
}

double FitTerm::slope(double observed) const {
  const bool is_inside = window && observed >= window->low && observed <= window->high;
  return is_inside ? 0 : 1 / deviation;
}

bool FitTerm::is_met(double observed, double deviations) const {
  return window ? observed >= window->low && observed <= window->high
                : std::abs(observed - value) <= deviations * deviation;
}

std::function<ModelSlopes(const VectorXd&)> central_differences(
    std::function<VectorXd(const VectorXd&)> values, std::vector<FitRange> ranges,
    unsigned threads) {
  constexpr double kStep = 1e-3;  // fraction of the range
  return [values = std::move(values), ranges = std::move(ranges), threads](const VectorXd& at) {
    const Index count = at.size();
    std::vector<VectorXd> found(static_cast<std::size_t>(2 * count + 1));
    const auto moved_steps = [&](Index k) {
      const FitRange& range = ranges[static_cast<std::size_t>(k)];
      return steps_of(range, at[k], kStep * range.width());
    };
    in_parallel(found.size(), threads, [&](std::size_t number) {
      const auto task = static_cast<Index>(number);
      VectorXd place = at;
      if (task > 0) {
        const auto [one, other] = moved_steps((task - 1) / 2);
        place[(task - 1) / 2] += task % 2 == 1 ? one : other;
      }
      found[number] = values(place);
    });
    ModelSlopes slopes{found.front(), MatrixXd(found.front().size(), count)};
    for (Index k = 0; k < count; ++k) {
      const auto [one, other] = moved_steps(k);
      const VectorXd by_one = found[static_cast<std::size_t>(2 * k + 1)] - found.front();
      const VectorXd by_other = found[static_cast<std::size_t>(2 * k + 2)] - found.front();
      // The slope of the parabola through the three points.
      slopes.derivatives.col(k) =
          (by_one * (other / one) - by_other * (one / other)) / (other - one);
    }
    return slopes;
  };
}

FitObjective::FitObjective(std::vector<FitRange> ranges, std::vector<FitTerm> terms, FitModel model)
    : ranges_(std::move(ranges)), terms_(std::move(terms)), model_(std::move(model)) {
  for (std::size_t k = 0; k < terms_.size(); ++k)
    if (!terms_[k].is_held_out && !terms_[k].must_hold) fitted_.push_back(k);
  const auto priors = std::count_if(ranges_.begin(), ranges_.end(),
                                    [](const FitRange& each) { return each.prior.has_value(); });
  told_count_ = static_cast<Index>(fitted_.size()) + priors;
  residual_count_ = std::max(told_count_, parameter_count());
}

bool FitObjective::has_limits() const {
  return std::any_of(terms_.begin(), terms_.end(),
                     [](const FitTerm& each) { return each.must_hold; });
}

VectorXd FitObjective::parameters(const VectorXd& place) const {
  VectorXd found(place.size());
  for (Index k = 0; k < place.size(); ++k) {
    const FitRange& range = ranges_[static_cast<std::size_t>(k)];
    found[k] = std::clamp(range.from + place[k] * range.width(), range.from, range.to);
  }
  return found;
}

VectorXd FitObjective::place(const VectorXd& parameters) const {
  VectorXd found(parameters.size());
  for (Index k = 0; k < parameters.size(); ++k) {
    const FitRange& range = ranges_[static_cast<std::size_t>(k)];
    found[k] = (parameters[k] - range.from) / range.width();
  }
  return found;
}

VectorXd FitObjective::residuals(const VectorXd& place, const VectorXd& values) const {
  VectorXd found = VectorXd::Zero(residual_count_);
  Index row = 0;
  for (const std::size_t term : fitted_)
    found[row++] = terms_[term].residual(values[static_cast<Index>(term)]);
  const VectorXd at = parameters(place);
  for (std::size_t k = 0; k < ranges_.size(); ++k)
    if (const auto& prior = ranges_[k].prior)
      found[row++] = (at[static_cast<Index>(k)] - prior->mean) / prior->deviation;
  return found;
}

VectorXd FitObjective::residuals_or_bad(const VectorXd& place,
                                        const std::function<VectorXd(const VectorXd&)>& values,
                                        std::string& problem) const {
  try {
    VectorXd found = residuals(place, values(parameters(place)));
    if (found.allFinite()) return found;
    problem = "a figure is not finite";
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    problem = error.what();
  }
  constexpr double kBad = 1e12;
  return VectorXd::Constant(residual_count(), kBad);
}

MatrixXd FitObjective::jacobian(const ModelSlopes& slopes) const {
  MatrixXd found = MatrixXd::Zero(residual_count_, parameter_count());
  Index row = 0;
  for (const std::size_t term : fitted_) {
    const auto k = static_cast<Index>(term);
    found.row(row++) = terms_[term].slope(slopes.values[k]) * slopes.derivatives.row(k);
  }
  for (std::size_t k = 0; k < ranges_.size(); ++k)
    if (const auto& prior = ranges_[k].prior)
      found(row++, static_cast<Index>(k)) = 1 / prior->deviation;
  for (std::size_t k = 0; k < ranges_.size(); ++k)
    found.col(static_cast<Index>(k)) *= ranges_[k].width();
  return found;
}

}  // namespace flexneck::pipeline
