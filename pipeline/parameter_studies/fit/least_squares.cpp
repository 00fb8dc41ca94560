// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/fit/least_squares.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>
#include <optional>
#include <unsupported/Eigen/LevenbergMarquardt>

#include "pipeline/parameter_studies/fit/limited_fit.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Free variables x, centred at pi instead of 0 so that MINPACK's first step, a fraction of their
/// norm, is the same for every start.
double place_of(double x) { return 0.5 * (1 + std::sin(x - std::numbers::pi)); }
double variable_of(double place) { return std::asin(2 * place - 1) + std::numbers::pi; }
double slope_at(double x) { return 0.5 * std::cos(x - std::numbers::pi); }

/// Functor that MINPACK calls.
class Functor : public Eigen::DenseFunctor<double> {
 public:
  Functor(const FitObjective& objective, VectorXd start, const FitSearch& search)
      : Eigen::DenseFunctor<double>(static_cast<int>(free_of(search, start.size()).size()),
                                    static_cast<int>(objective.residual_count())),
        objective_(objective),
        place_(std::move(start)),
        search_(search),
        free_(free_of(search, place_.size())) {}

  VectorXd variables() const {
    constexpr double kIn = 0.01;
    VectorXd x(static_cast<Index>(free_.size()));
    for (std::size_t k = 0; k < free_.size(); ++k)
      x[static_cast<Index>(k)] = variable_of(std::clamp(place_[free_[k]], kIn, 1 - kIn));
    return x;
  }

  VectorXd place(const VectorXd& x) const {
    VectorXd found = place_;
    for (std::size_t k = 0; k < free_.size(); ++k)
      found[free_[k]] = place_of(x[static_cast<Index>(k)]);
    return found;
  }

  int operator()(const VectorXd& x, VectorXd& residuals) {
    if (search_.is_stopped != nullptr && search_.is_stopped->load()) throw FitStopped();
    const VectorXd at = place(x);
    ++evaluations_;
    residuals = objective_.residuals_or_bad(at, objective_.model().values, problem_);
    return 0;
  }

  int df(const VectorXd& x, MatrixXd& jacobian) {
    const VectorXd at = place(x);
    ++evaluations_;
    const MatrixXd whole = objective_.jacobian(slopes(at));
    jacobian.resize(values(), inputs());
    for (std::size_t k = 0; k < free_.size(); ++k)
      jacobian.col(static_cast<Index>(k)) =
          whole.col(free_[k]) * slope_at(x[static_cast<Index>(k)]);
    return 0;
  }

  int evaluations() const { return evaluations_; }
  const std::string& problem() const { return problem_; }

 private:
  static std::vector<Index> free_of(const FitSearch& search, Index count) {
    std::vector<Index> free;
    for (Index k = 0; k < count; ++k)
      if (search.is_held.empty() || !search.is_held[static_cast<std::size_t>(k)]) free.push_back(k);
    return free;
  }

  ModelSlopes slopes(const VectorXd& at) const {
    return objective_.model().slopes(objective_.parameters(at));
  }

  const FitObjective& objective_;
  VectorXd place_;
  const FitSearch& search_;
  std::vector<Index> free_;
  int evaluations_ = 0;
  std::string problem_;  ///< problem at the last place that failed
};

using Status = Eigen::LevenbergMarquardtSpace::Status;

bool has_converged(Status status) {
  using namespace Eigen::LevenbergMarquardtSpace;
  return status == RelativeReductionTooSmall || status == RelativeErrorTooSmall ||
         status == RelativeErrorAndReductionTooSmall || status == CosinusTooSmall ||
         status == FtolTooSmall || status == XtolTooSmall || status == GtolTooSmall;
}

/// Runs the minimisation to its end. @return true if that is a minimum
bool minimise(Functor& functor, VectorXd& x, const FitSearch& search) {
  constexpr double kTolerance = 1e-4;       // relative to the sum of squares
  constexpr double kPlaceTolerance = 1e-6;  // relative to the norm of the variables
  // Fraction of the norm of the variables, which are about pi each.
  constexpr double kFirstStep = 0.1;
  Eigen::LevenbergMarquardt<Functor> method(functor);
  method.setFtol(kTolerance);
  method.setXtol(kPlaceTolerance);
  method.setFactor(kFirstStep);
  method.setMaxfev(10L * search.steps);  // a step may take several evaluations
  method.setExternalScaling(true);
  method.diag() = VectorXd::Ones(x.size());
  Status status = method.minimizeInit(x);
  if (method.fvec().size() > 0 && status == Status::NotStarted) status = Status::Running;
  for (int step = 0; status == Status::Running && step < search.steps; ++step)
    status = method.minimizeOneStep(x);
  return has_converged(status);
}

}  // namespace

bool is_at_bound(double place) { return place < kAtBound || place > 1 - kAtBound; }

Minimum least_squares(const FitObjective& objective, const VectorXd& start,
                      const FitSearch& search) {
  if (objective.has_limits()) return least_squares_within_limits(objective, start, search);
  Functor functor(objective, start, search);
  VectorXd x = functor.variables();
  Minimum found;
  try {
    found.has_converged = x.size() == 0 || minimise(functor, x, search);
    found.place = functor.place(x);
    found.values = objective.model().values(objective.parameters(found.place));
    const VectorXd residuals = objective.residuals(found.place, found.values);
    found.chi_squared = residuals.squaredNorm();
    if (!residuals.allFinite()) found.problem = "a figure is not finite";
  } catch (const FitStopped&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    found.problem = error.what();
    found.place = functor.place(x);
  }
  found.evaluations = functor.evaluations();
  return found;
}

}  // namespace flexneck::pipeline
