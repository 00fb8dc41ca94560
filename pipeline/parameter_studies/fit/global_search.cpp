// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/fit/global_search.h"

#include <nlopt.hpp>
#include <vector>

#include "pipeline/parameter_studies/fit/least_squares.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Data of the function that NLopt calls.
struct Searched {
  const FitObjective& objective;
  const std::function<VectorXd(const VectorXd&)>& values;
  const std::atomic<bool>* is_stopped;

  static double chi_squared(const std::vector<double>& at, std::vector<double>& /*gradient*/,
                            void* data) {
    const auto& of = *static_cast<const Searched*>(data);
    if (of.is_stopped != nullptr && of.is_stopped->load()) throw nlopt::forced_stop();
    const VectorXd place = VectorXd::Map(at.data(), static_cast<Index>(at.size()));
    std::string problem;
    return of.objective.residuals_or_bad(place, of.values, problem).squaredNorm();
  }
};

}  // namespace

VectorXd best_of_search(const FitObjective& objective,
                        const std::function<VectorXd(const VectorXd&)>& values,
                        const VectorXd& start, const GlobalSearch& search) {
  constexpr double kSmall = 1e-3;  // fraction of the cube's edge
  Searched searched{objective, values, search.is_stopped};
  nlopt::opt method(nlopt::GN_CRS2_LM, static_cast<unsigned>(start.size()));
  method.set_lower_bounds(0.0);
  method.set_upper_bounds(1.0);
  method.set_maxeval(search.evaluations);
  method.set_xtol_abs(kSmall);
  method.set_min_objective(Searched::chi_squared, &searched);
  nlopt::srand(search.seed);  // affects this thread only
  std::vector<double> best(start.begin(), start.end());
  double least = 0;
  try {
    method.optimize(best, least);
  } catch (const nlopt::forced_stop&) {
    throw FitStopped();
  }
  return VectorXd::Map(best.data(), start.size());
}

}  // namespace flexneck::pipeline
