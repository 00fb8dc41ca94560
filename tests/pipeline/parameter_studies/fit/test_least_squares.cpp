// SPDX-License-Identifier: GPL-3.0-or-later
// Minima, their standard deviations, families, profiles and proportions, against closed forms.
#include <cmath>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "pipeline/parameter_studies/fit/families.h"
#include "pipeline/parameter_studies/fit/history.h"
#include "pipeline/parameter_studies/fit/identifiability.h"
#include "pipeline/parameter_studies/fit/profile.h"
#include "tests/pipeline/parameter_studies/fit/closed_models.h"

using namespace flexneck::pipeline;
using namespace flexneck::testing;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

VectorXd vector(std::initializer_list<double> values) {
  return VectorXd::Map(values.begin(), static_cast<Index>(values.size()));
}

/// Matrix of a linear model with three observables and two parameters.
MatrixXd line_matrix() {
  MatrixXd a(3, 2);
  a << 1, 2, -1, 1, 3, 0.5;
  return a;
}
VectorXd line(const VectorXd& p) { return line_matrix() * p; }

FitObjective line_objective(std::vector<FitRange> ranges, const VectorXd& wanted,
                            double deviation) {
  FitModel model = model_of(line, ranges);
  return {std::move(ranges), targets(wanted, deviation), std::move(model)};
}

const std::vector<FitRange> kLineRanges = {{"a", -10, 10, {}}, {"b", -20, 20, {}}};

VectorXd square(const VectorXd& p) { return vector({p[0] * p[0]}); }
VectorXd only_sum(const VectorXd& p) { return vector({p[0] + p[1], 2 * (p[0] + p[1])}); }

}  // namespace

TEST_CASE("a linear fit and its error bars are those of the normal equations") {
  const VectorXd wanted = vector({3, 0.5, -2});
  const FitObjective objective = line_objective(kLineRanges, wanted, 0.2);
  const Minimum found = least_squares(objective, vector({0.9, 0.1}), {});
  REQUIRE_FALSE(found.has_failed());
  CHECK(found.has_converged);
  const MatrixXd a = line_matrix();
  const MatrixXd information = a.transpose() * a / (0.2 * 0.2);
  const VectorXd truth = (a.transpose() * a).ldlt().solve(a.transpose() * wanted);
  CHECK((objective.parameters(found.place) - truth).norm() < 1e-6);
  CHECK(found.chi_squared == Approx((a * truth - wanted).squaredNorm() / 0.04));
  const Identifiability known = identifiability(
      objective, objective.jacobian(objective.model().slopes(objective.parameters(found.place))));
  const MatrixXd covariance = information.inverse();
  for (Index k = 0; k < 2; ++k)
    CHECK(known.deviation(k) * objective.ranges()[static_cast<std::size_t>(k)].width() ==
          Approx(std::sqrt(covariance(k, k))).epsilon(1e-6));
  CHECK(known.correlations(0, 1) ==
        Approx(covariance(0, 1) / std::sqrt(covariance(0, 0) * covariance(1, 1))));
  // Covariance without the third target: that of the other two.
  const MatrixXd two = (a.topRows(2).transpose() * a.topRows(2) / 0.04).inverse();
  CHECK(known.widening(2, 0) == Approx(std::sqrt(two(0, 0) / covariance(0, 0))));
  // The profile of a linear model is a parabola, whose ends are 1.96 deviations away.
  const Profile profile = profile_of(objective, found, 0, known.deviation(0), {});
  REQUIRE((profile.low && profile.high));
  CHECK(*profile.high - found.place[0] == Approx(1.959964 * known.deviation(0)).epsilon(0.01));
  CHECK(found.place[0] - *profile.low == Approx(1.959964 * known.deviation(0)).epsilon(0.01));
}

TEST_CASE("a minimum beyond a bound is found at the bound") {
  // Without bounds the first parameter would be negative.
  const FitObjective objective =
      line_objective({{"a", 0, 10, {}}, {"b", -20, 20, {}}}, vector({-3, 1, -9}), 1);
  const Minimum found = least_squares(objective, vector({0.5, 0.5}), {});
  CHECK(is_at_bound(found.place[0]));
  // The second parameter is the best one with the first at 0.
  const VectorXd column = line_matrix().col(1);
  const double best = column.dot(vector({-3, 1, -9})) / column.squaredNorm();
  CHECK(objective.parameters(found.place)[1] == Approx(best).margin(1e-3));
  CHECK(is_at_bound(0));
  CHECK_FALSE(is_at_bound(0.5));
}

TEST_CASE("a normal prior counts as a measurement of the parameter") {
  std::vector<FitRange> ranges = {{"a", -10, 10, FitRange::Normal{2, 0.5}}, {"b", -20, 20, {}}};
  const FitObjective objective = line_objective(ranges, vector({3, 0.5, -2}), 0.2);
  MatrixXd a(4, 2);
  a << line_matrix() / 0.2, 1 / 0.5, 0;
  const VectorXd wanted = vector({3 / 0.2, 0.5 / 0.2, -2 / 0.2, 2 / 0.5});
  const VectorXd truth = (a.transpose() * a).ldlt().solve(a.transpose() * wanted);
  const Minimum found = least_squares(objective, vector({0.3, 0.3}), {});
  CHECK((objective.parameters(found.place) - truth).norm() < 1e-6);
}

TEST_CASE("two minima are two families, and equal ones one") {
  const std::vector<FitRange> ranges = {{"x", -3, 3, {}}};
  const FitObjective objective(ranges, targets(vector({4}), 0.1), model_of(square, ranges));
  std::vector<Minimum> minima;
  for (const double start : {0.1, 0.9, 0.7, 0.3})
    minima.push_back(least_squares(objective, vector({start}), {}));
  const std::vector<Family> families = families_of(objective, minima);
  REQUIRE(families.size() == 2);
  CHECK(families[0].starts.size() + families[1].starts.size() == 4);
  for (const Family& each : families) {
    CHECK((each.is_as_good && each.meets_targets));
    CHECK(std::abs(objective.parameters(each.best.place)[0]) == Approx(2).epsilon(1e-6));
  }
}

TEST_CASE("a direction that no target fixes is told with the parameters it is made of") {
  const std::vector<FitRange> ranges = {{"x", 0, 2, {}}, {"y", 0, 2, {}}};
  const FitObjective objective(ranges, targets(vector({2, 4}), 0.01), model_of(only_sum, ranges));
  const Minimum found = least_squares(objective, vector({0.2, 0.3}), {});
  CHECK(found.chi_squared < 1e-9);
  const Identifiability known = identifiability(
      objective, objective.jacobian(objective.model().slopes(objective.parameters(found.place))));
  CHECK(known.singular_values[1] < kLeastSingularValue);
  CHECK(parameters_along(known.directions.col(1)).size() == 2);
  CHECK(std::isinf(known.deviation(0)));
  CHECK(std::isnan(known.correlations(0, 1)));
  const Profile profile = profile_of(objective, found, 0, known.deviation(0), {});
  CHECK_FALSE(profile.low);
  CHECK_FALSE(profile.high);
}

TEST_CASE("all of a window is equally good, and its edges decide") {
  FitTerm term{"y", 0, 0.5, FitTerm::Window{1, 3}, false};
  CHECK(term.residual(1) == 0);
  CHECK(term.residual(3) == 0);
  CHECK(term.residual(3.5) == Approx(1));
  CHECK(term.residual(0) == Approx(-2));
  CHECK(term.slope(2) == 0);
  CHECK_FALSE(term.is_met(3.0001, 3));
  const std::vector<FitRange> ranges = {{"x", -3, 3, {}}};
  const FitObjective objective(ranges, {term}, model_of(square, ranges));
  // The search moves from 8.41 into the window, and no further.
  const Minimum found = least_squares(objective, vector({2.9 / 6 + 0.5}), {});
  CHECK(found.values[0] == Approx(3).epsilon(1e-3));
  CHECK(found.chi_squared < 1e-5);
}

TEST_CASE("places at which the model fails are gone round") {
  const std::vector<FitRange> ranges = {{"x", 0, 10, {}}};
  const auto values = [](const VectorXd& p) -> VectorXd {
    if (p[0] > 5) throw std::runtime_error("too large");
    return vector({std::exp(p[0])});
  };
  const FitObjective objective(ranges, targets(vector({std::exp(4.0)}), 0.1),
                               {values, central_differences(values, ranges)});
  const Minimum found = least_squares(objective, vector({0.05}), {});
  CHECK(objective.parameters(found.place)[0] == Approx(4).epsilon(1e-5));
  const Minimum none = least_squares(objective, vector({0.8}), {});
  CHECK(none.problem == "too large");
  CHECK(families_of(objective, {none}).empty());
}

TEST_CASE("slopes at a bound are of second order, too") {
  const std::vector<FitRange> ranges = {{"x", 1, 2, {}}, {"y", 1, 2, {}}};
  const auto cubes = [](const VectorXd& p) -> VectorXd {
    return vector({p[0] * p[0] * p[0], p[0] * p[1] * p[1]});
  };
  const auto slopes = central_differences(cubes, ranges, 3);
  for (const double x : {1.0, 1.5, 2.0}) {
    const ModelSlopes found = slopes(vector({x, 2}));
    CHECK(found.derivatives(0, 0) == Approx(3 * x * x).epsilon(1e-5));
    CHECK(found.derivatives(0, 1) == 0);
    CHECK(found.derivatives(1, 1) == Approx(4 * x).epsilon(1e-5));
  }
}

TEST_CASE("a share has the interval of Clopper and Pearson") {
  // For 10 in 100, Pearson's own example gives 0.0490 and 0.1762.
  const Share tenth = share_of(10, 100);
  CHECK(tenth.value == Approx(0.1));
  CHECK(tenth.low == Approx(0.0490047).epsilon(1e-5));
  CHECK(tenth.high == Approx(0.1762226).epsilon(1e-5));
  // For 0 the upper limit is 1 - 0.025^(1/n).
  const Share none = share_of(0, 50);
  CHECK(none.low == 0);
  CHECK(none.high == Approx(1 - std::pow(0.025, 1.0 / 50)));
  CHECK(share_of(0, 0).high == 1);
}

TEST_CASE("error bars cover the truth in 95 of 100 repeats with noise") {
  // 1000 repeats, seeds 1 to 1000; 95 +- 2 % is 2.9 deviations of such a count.
  const std::vector<FitRange> ranges = {
      {"amplitude", 0.5, 2, {}}, {"damping", 0, 3, {}}, {"frequency", 0.5, 2, {}}};
  const VectorXd truth = vector({1.1, 0.9, 1.3});
  constexpr int kRepeats = 1000;
  Eigen::Vector3i covered = Eigen::Vector3i::Zero();
  Eigen::Vector3i profiled = Eigen::Vector3i::Zero();
  for (int seed = 1; seed <= kRepeats; ++seed) {
    const FitObjective objective(ranges,
                                 noisy(oscillation(truth), 0.01, static_cast<std::uint64_t>(seed)),
                                 model_of(oscillation, ranges));
    const Minimum found = least_squares(objective, vector({0.45, 0.25, 0.5}), {});
    REQUIRE(found.has_converged);
    const Identifiability known = identifiability(
        objective, objective.jacobian(objective.model().slopes(objective.parameters(found.place))));
    const VectorXd at = objective.place(truth);
    for (Index k = 0; k < 3; ++k) {
      covered[k] += std::abs(found.place[k] - at[k]) <= 1.959964 * known.deviation(k) ? 1 : 0;
      const Profile profile = profile_of(objective, found, k, known.deviation(k), {});
      profiled[k] +=
          profile.low && profile.high && *profile.low <= at[k] && at[k] <= *profile.high ? 1 : 0;
    }
  }
  for (Index k = 0; k < 3; ++k) {
    INFO(covered.transpose() << " | " << profiled.transpose());
    CHECK(std::abs(covered[k] - 0.95 * kRepeats) <= 0.02 * kRepeats);
    CHECK(std::abs(profiled[k] - 0.95 * kRepeats) <= 0.02 * kRepeats);
  }
}
