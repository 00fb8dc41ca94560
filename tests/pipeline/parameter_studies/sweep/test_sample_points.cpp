// SPDX-License-Identifier: GPL-3.0-or-later
// Points of the unit cube and distributions, against their definitions.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "pipeline/parameter_studies/sampling/counter_random.h"
#include "pipeline/parameter_studies/sampling/distribution.h"
#include "pipeline/parameter_studies/sampling/unit_points.h"
#include "pipeline/parameter_studies/sweep/correlation.h"

using Eigen::Index;
using Eigen::VectorXd;
using namespace flexneck;
using namespace flexneck::pipeline;
using Kind = SweepDistribution::Kind;

namespace {

/// Number of points in each of `parts` equal parts of a coordinate.
std::vector<int> counts_in_parts(const UnitPoints& points, int coordinate, int parts) {
  std::vector<int> counts(static_cast<std::size_t>(parts), 0);
  for (std::uint64_t row = 0; row < points.row_count(); ++row) {
    const double u = points.point(row)[coordinate];
    REQUIRE(u > 0);
    REQUIRE(u < 1);
    ++counts[static_cast<std::size_t>(u * parts)];
  }
  return counts;
}

bool all_are(const std::vector<int>& counts, int expected) {
  return std::all_of(counts.begin(), counts.end(), [&](int count) { return count == expected; });
}

/// Mean and standard deviation of a distribution by the midpoint rule over its quantiles.
std::pair<double, double> moments(const SweepDistribution& distribution) {
  constexpr int kParts = 200000;
  double sum = 0;
  double square = 0;
  for (int k = 0; k < kParts; ++k) {
    const double x = quantile(distribution, (k + 0.5) / kParts);
    sum += x;
    square += x * x;
  }
  const double mean = sum / kParts;
  return {mean, std::sqrt(square / kParts - mean * mean)};
}

SweepDistribution between(Kind kind, double low, double high) {
  SweepDistribution distribution;
  distribution.kind = kind;
  distribution.low = low;
  distribution.high = high;
  return distribution;
}

SweepDistribution bell(Kind kind, double mean, double standard_deviation) {
  SweepDistribution distribution;
  distribution.kind = kind;
  distribution.mean = mean;
  distribution.standard_deviation = standard_deviation;
  return distribution;
}

SweepSection correlated_by(const std::vector<double>& coefficients) {
  SweepSection sweep;
  sweep.parameters.resize(3);
  const std::array<std::array<std::size_t, 2>, 3> pairs = {{{0, 1}, {0, 2}, {1, 2}}};
  for (std::size_t k = 0; k < coefficients.size(); ++k)
    sweep.correlations.push_back({pairs[k], coefficients[k]});
  return sweep;
}

}  // namespace

TEST_CASE("a random order in constant memory is an order, and another with another key") {
  for (const std::uint32_t count : {1U, 2U, 3U, 17U, 64U, 1000U}) {
    std::set<std::uint32_t> places;
    for (std::uint32_t k = 0; k < count; ++k) places.insert(permuted(k, count, 12345));
    CHECK(places.size() == count);
    CHECK(*places.rbegin() == count - 1);
  }
  int same = 0;
  for (std::uint32_t k = 0; k < 1000; ++k) same += permuted(k, 1000, 1) == permuted(k, 1000, 2);
  CHECK(same < 10);  // one is expected
}

TEST_CASE("a Latin hypercube has one sample in each part of each coordinate") {
  for (const std::uint32_t samples : {1U, 7U, 100U}) {
    const UnitPoints points{SweepPlan::latin_hypercube, samples, 3, 5};
    for (int k = 0; k < 3; ++k)
      CHECK(all_are(counts_in_parts(points, k, static_cast<int>(samples)), 1));
  }
}

TEST_CASE("the first 2^m points of the shifted Sobol' sequence are evenly spread") {
  const UnitPoints points{SweepPlan::sobol, 256, 5, 3};
  for (int k = 0; k < 5; ++k) CHECK(all_are(counts_in_parts(points, k, 256), 1));
  // In the first two coordinates each of 16 x 16 squares has one point.
  std::vector<int> squares(256, 0);
  for (std::uint64_t row = 0; row < 256; ++row) {
    const VectorXd point = points.point(row);
    ++squares[static_cast<std::size_t>(point[0] * 16) * 16 +
              static_cast<std::size_t>(point[1] * 16)];
  }
  CHECK(all_are(squares, 1));
}

TEST_CASE("rows for Sobol' indices are A, B and A with each coordinate of B") {
  const UnitPoints points{SweepPlan::sobol_indices, 8, 3, 1};
  REQUIRE(points.rows_per_sample() == 5);
  REQUIRE(points.row_count() == 40);
  for (std::uint64_t sample = 0; sample < 8; ++sample) {
    const VectorXd a = points.point(5 * sample);
    const VectorXd b = points.point(5 * sample + 1);
    for (Index i = 0; i < 3; ++i) {
      VectorXd mixed = a;
      mixed[i] = b[i];
      CHECK(points.point(5 * sample + 2 + static_cast<std::uint64_t>(i)) == mixed);
    }
  }
}

TEST_CASE("a seed gives other points, the same seed the same") {
  for (const SweepPlan plan : {SweepPlan::random, SweepPlan::latin_hypercube, SweepPlan::sobol}) {
    const UnitPoints first{plan, 16, 2, 1};
    const UnitPoints again{plan, 16, 2, 1};
    const UnitPoints other{plan, 16, 2, 2};
    CHECK(first.point(7) == again.point(7));
    CHECK(first.point(7) != other.point(7));
  }
}

TEST_CASE("distributions have the moments of their closed forms") {
  constexpr double kRule = 1e-4;  // error of the midpoint rule in the tails
  const auto check = [&](const SweepDistribution& distribution, double mean, double deviation) {
    const auto [found_mean, found_deviation] = moments(distribution);
    CHECK(found_mean == Approx(mean).epsilon(kRule));
    CHECK(found_deviation == Approx(deviation).epsilon(kRule));
  };
  check(between(Kind::uniform, 2, 5), 3.5, 3 / std::sqrt(12));
  // E x^n = (b^n - a^n) / (n log(b / a))
  const double l = std::log(10.0);
  check(between(Kind::log_uniform, 1, 10), 9 / l, std::sqrt(99 / (2 * l) - 81 / (l * l)));
  check(bell(Kind::normal, 3, 0.5), 3, 0.5);
  check(bell(Kind::lognormal, 3, 0.5), 3, 0.5);
  SweepDistribution triangle = between(Kind::triangular, 1, 5);
  triangle.mode = 2;
  // (a + b + c) / 3, sqrt((a^2 + b^2 + c^2 - ab - ac - bc) / 18)
  check(triangle, 8.0 / 3, std::sqrt((1 + 25 + 4 - 5 - 2 - 10) / 18.0));
  SweepDistribution half = bell(Kind::normal, 0, 1);
  half.low = 0;
  // Half of a normal distribution: sqrt(2 / pi), sqrt(1 - 2 / pi)
  check(half, std::sqrt(2 / std::numbers::pi), std::sqrt(1 - 2 / std::numbers::pi));
}

TEST_CASE("a normal distribution that is cut off far out keeps its digits on either side") {
  SweepDistribution upper = bell(Kind::normal, 0, 1);
  upper.low = 7;
  SweepDistribution lower = bell(Kind::normal, 0, 1);
  lower.high = -7;
  for (const double u : {0.01, 0.3, 0.5, 0.99}) {
    CHECK(quantile(upper, u) == Approx(-quantile(lower, 1 - u)).epsilon(1e-12));
    CHECK(quantile(upper, u) > 7);
    // 1 - Phi(x) = (1 - u) (1 - Phi(7))
    CHECK(normal_cdf(-quantile(upper, u)) == Approx((1 - u) * normal_cdf(-7)).epsilon(1e-9));
  }
}

TEST_CASE("a discrete distribution has its weights, and none of weight zero") {
  SweepDistribution discrete;
  discrete.kind = Kind::discrete;
  discrete.weights = {0.25, 0, 0.75, 0};
  CHECK(discrete_quantile(discrete, 1e-16) == 0);
  CHECK(discrete_quantile(discrete, 0.2499) == 0);
  CHECK(discrete_quantile(discrete, 0.2501) == 2);
  CHECK(discrete_quantile(discrete, 1 - 1e-16) == 2);
}

TEST_CASE("correlated scores have the correlation, and each coordinate stays uniform") {
  const Correlation correlation(correlated_by({0.6, -0.3}));
  constexpr std::uint32_t kSamples = 1U << 14U;
  const UnitPoints points{SweepPlan::sobol, kSamples, 3, 1};
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::uint64_t row = 0; row < kSamples; ++row) {
    const VectorXd u = correlation.correlated(points.point(row));
    const VectorXd z = u.unaryExpr(&normal_quantile);
    products += z * z.transpose() / kSamples;
    sum += u / kSamples;
  }
  CHECK((products - correlation.matrix()).cwiseAbs().maxCoeff() < 0.01);
  CHECK((sum.array() - 0.5).abs().maxCoeff() < 0.01);
}

TEST_CASE("coefficients that contradict each other are refused") {
  CHECK_THROWS_AS(Correlation(correlated_by({0.9, 0.9, -0.9})), InputError);
  CHECK_THROWS_AS(Correlation(correlated_by({1.0})), InputError);
}
