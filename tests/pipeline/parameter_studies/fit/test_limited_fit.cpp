// SPDX-License-Identifier: GPL-3.0-or-later
// Windows as constraints, against the nearest points of sets in closed form.
#include <catch2/catch.hpp>

#include "pipeline/parameter_studies/fit/limited_fit.h"
#include "pipeline/parameter_studies/fit/profile.h"
#include "tests/pipeline/parameter_studies/fit/closed_models.h"

using Catch::Matchers::Contains;
using namespace flexneck::pipeline;
using namespace flexneck::testing;
using Eigen::Vector2d;
using Eigen::VectorXd;

namespace {

/// Observables of a point: its coordinates, their sum and the squared distance from the origin.
VectorXd plane(const VectorXd& p) {
  return Eigen::Vector4d(p[0], p[1], p[0] + p[1], p.squaredNorm());
}

/// Objective: the point nearest to a given one, with limits on the sum and on the squared distance.
FitObjective nearest(const Vector2d& point, FitTerm::Window sum, FitTerm::Window square) {
  const std::vector<FitRange> ranges = {{"x", -10, 10, {}}, {"y", -10, 10, {}}};
  std::vector<FitTerm> terms = {{"x", point[0], 0.1, {}, false},
                                {"y", point[1], 0.1, {}, false},
                                {"sum", 0, 0.1, sum, false, true},
                                {"square", 0, 0.1, square, false, true}};
  return {ranges, std::move(terms), model_of(plane, ranges)};
}

Vector2d found_by(const FitObjective& objective, const Vector2d& start) {
  const Minimum found = least_squares(objective, objective.place(start), {});
  INFO(found.problem);
  REQUIRE_FALSE(found.has_failed());
  CHECK(found.has_converged);
  for (const std::size_t k : {2U, 3U})
    CHECK(objective.terms()[k].is_met(found.values[static_cast<Eigen::Index>(k)], 0));
  return objective.parameters(found.place);
}

}  // namespace

TEST_CASE("a fit ends at the nearest place where a window holds") {
  const FitTerm::Window any;
  // The solution is on the line x + y = 2, from either side of it.
  const FitObjective line = nearest({3, 1}, {.high = 2}, any);
  CHECK((found_by(line, {7, 5}) - Vector2d(2, 0)).norm() < 2e-3);
  CHECK((found_by(line, {-5, -6}) - Vector2d(2, 0)).norm() < 2e-3);
  CHECK((found_by(nearest({3, 1}, {.low = 6}, any), {0, 0}) - Vector2d(4, 2)).norm() < 2e-3);
  // The solution is on the unit circle.
  CHECK((found_by(nearest({3, 4}, any, {.high = 1}), {5, -2}) - Vector2d(0.6, 0.8)).norm() < 2e-3);
  // The solution is in the corner of both constraints: x + y = 1 on the circle.
  CHECK((found_by(nearest({3, 0.5}, {.high = 1}, {.high = 1}), {2, 0.5}) - Vector2d(1, 0)).norm() <
        5e-3);
}

TEST_CASE("a window that holds anyway changes nothing, and adds nothing to chi-squared") {
  const FitObjective objective = nearest({3, 1}, {.low = 0, .high = 9}, {.high = 99});
  CHECK((found_by(objective, {0, 0}) - Vector2d(3, 1)).norm() < 1e-6);
  const Minimum at_line =
      least_squares(nearest({3, 1}, {.high = 2}, {}), objective.place(Vector2d(0, 0)), {});
  CHECK(at_line.chi_squared == Approx(2 / 0.01).epsilon(1e-3));
}

TEST_CASE("windows that cannot hold together are told by a target") {
  const FitObjective objective = nearest({3, 1}, {.low = 5}, {.high = 1});
  const Minimum found = least_squares(objective, objective.place(Vector2d(1, 1)), {});
  CHECK_THAT(found.problem, Contains("no point was found at which"));
}

TEST_CASE("the confidence of a parameter ends where no place is left that keeps to a window") {
  // Without the constraint x has 3 +- 0.196; the circle of radius 3.05 limits it to 3.05, where y
  // may be 0.
  const FitObjective objective = nearest({3, 0}, {}, {.high = 3.05 * 3.05});
  const Minimum found = least_squares(objective, objective.place(Vector2d(1, 1)), {});
  const Profile profile = profile_of(objective, found, 0, 0.1 / 20, {});
  REQUIRE((profile.low && profile.high));
  CHECK(objective.ranges()[0].from + *profile.low * 20 == Approx(3 - 0.196).margin(0.01));
  CHECK(objective.ranges()[0].from + *profile.high * 20 == Approx(3.05).margin(0.02));
}
