// SPDX-License-Identifier: GPL-3.0-or-later
// A search over all of the bounds for an objective with many minima.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "pipeline/parameter_studies/fit/global_search.h"
#include "pipeline/parameter_studies/fit/least_squares.h"
#include "tests/pipeline/parameter_studies/fit/closed_models.h"

using namespace flexneck::pipeline;
using namespace flexneck::testing;
using Eigen::Vector2d;
using Eigen::VectorXd;

namespace {

/// A sine with given amplitude and frequency at 60 times: there are minima at many frequencies.
VectorXd sine(const VectorXd& parameters) {
  VectorXd values(60);
  for (int k = 0; k < 60; ++k)
    values[k] = parameters[0] * std::sin(2 * std::numbers::pi * parameters[1] * k / 60);
  return values;
}

const std::vector<FitRange> kRanges = {{"amplitude", 0.1, 3, {}}, {"frequency", 0.5, 20, {}}};
const Vector2d kTruth(1.4, 7.3);

}  // namespace

TEST_CASE("a global search leads to the one minimum that the start does not") {
  const FitObjective objective(kRanges, targets(sine(kTruth), 0.01), model_of(sine, kRanges));
  const VectorXd start = objective.place(Vector2d(1, 16));
  const Minimum local = least_squares(objective, start, {});
  CHECK(local.chi_squared > 1000);
  for (const unsigned long seed : {1UL, 2UL}) {
    const VectorXd place = best_of_search(objective, sine, start, {.seed = seed});
    const Minimum found = least_squares(objective, place, {});
    CHECK(found.chi_squared < 1e-6);
    CHECK((objective.parameters(found.place) - kTruth).norm() < 1e-4);
    CHECK(best_of_search(objective, sine, start, {.seed = seed}) == place);
  }
}

TEST_CASE("a global search ends with its evaluations, and when it is stopped") {
  const FitObjective objective(kRanges, targets(sine(kTruth), 0.01), model_of(sine, kRanges));
  int evaluations = 0;
  const auto counted = [&](const VectorXd& at) -> VectorXd {
    ++evaluations;
    if (at[1] > 10) throw std::runtime_error("too quick");  // the search avoids it
    return sine(at);
  };
  const VectorXd start = objective.place(Vector2d(1, 16));
  const VectorXd place = best_of_search(objective, counted, start, {.evaluations = 150});
  CHECK(evaluations == 150);
  CHECK(objective.parameters(place)[1] < 10);
  const std::atomic<bool> stopped = true;
  CHECK_THROWS_AS(best_of_search(objective, sine, start, {.is_stopped = &stopped}), FitStopped);
}
