// SPDX-License-Identifier: GPL-3.0-or-later
// Estimates of sensitivity against closed forms, without a study.
#include <cmath>
#include <functional>
#include <numbers>

#include <catch2/catch.hpp>

#include "pipeline/parameter_studies/sampling/distribution.h"
#include "pipeline/parameter_studies/sampling/unit_points.h"
#include "pipeline/parameter_studies/sweep/shapley.h"
#include "pipeline/parameter_studies/sweep/sobol_indices.h"
#include "pipeline/results/report/sweep_pictures.h"

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using namespace flexneck::pipeline;

namespace {

using Function = std::function<double(const VectorXd&)>;

template <class PointOf>
MatrixXd values_of(std::uint64_t rows_per_sample, std::uint64_t samples, const PointOf& point,
                   const Function& function) {
  MatrixXd values(static_cast<Index>(rows_per_sample), static_cast<Index>(samples));
  for (std::uint64_t row = 0; row < rows_per_sample * samples; ++row)
    values(static_cast<Index>(row % rows_per_sample), static_cast<Index>(row / rows_per_sample)) =
        function(point(row));
  return values;
}

std::vector<SobolIndex> indices_of(int dimensions, std::uint32_t samples, std::uint64_t seed,
                                   const Function& function) {
  const UnitPoints points{SweepPlan::sobol_indices, samples, dimensions, seed};
  return sobol_indices(values_of(
                           points.rows_per_sample(), samples,
                           [&](std::uint64_t row) { return points.point(row); }, function),
                       seed);
}

bool holds(const Estimate& estimate, double truth) {
  return estimate.interval.low <= truth && truth <= estimate.interval.high;
}

double width(const Estimate& estimate) { return estimate.interval.high - estimate.interval.low; }

/// Function of Ishigami and Homma (1990): sin x1 + a sin^2 x2 + b x3^4 sin x1, x uniform from -pi
/// to pi.
constexpr double kA = 7;
constexpr double kB = 0.1;
double ishigami(const VectorXd& u) {
  const VectorXd x = std::numbers::pi * (2 * u.array() - 1);
  const double sine = std::sin(x[1]);
  return std::sin(x[0]) + kA * sine * sine + kB * std::pow(x[2], 4) * std::sin(x[0]);
}

/// Function of Sobol' (1993): the product of (|4 u_i - 2| + a_i) / (1 + a_i).
const std::vector<double> kG = {0, 1, 4.5, 9};
double g_function(const VectorXd& u) {
  double product = 1;
  for (Index k = 0; k < u.size(); ++k) {
    const double a = kG[static_cast<std::size_t>(k)];
    product *= (std::abs(4 * u[k] - 2) + a) / (1 + a);
  }
  return product;
}

}  // namespace

TEST_CASE("Sobol' indices of Ishigami's function are within their confidence") {
  // V1 = (1 + b pi^4 / 5)^2 / 2, V2 = a^2 / 8, V13 = b^2 pi^8 (1/18 - 1/50), the rest zero.
  const double pi4 = std::pow(std::numbers::pi, 4);
  const double v1 = std::pow(1 + kB * pi4 / 5, 2) / 2;
  const double v2 = kA * kA / 8;
  const double v13 = kB * kB * pi4 * pi4 * (1.0 / 18 - 1.0 / 50);
  const double v = v1 + v2 + v13;
  const double first[] = {v1 / v, v2 / v, 0};
  const double total[] = {(v1 + v13) / v, v2 / v, v13 / v};
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const std::vector<SobolIndex> found = indices_of(3, 4096, seed, ishigami);
    for (std::size_t k = 0; k < 3; ++k) {
      INFO("seed " << seed << ", input " << k);
      CHECK(holds(found[k].first, first[k]));
      CHECK(holds(found[k].total, total[k]));
      CHECK(width(found[k].first) < 0.1);
      CHECK(width(found[k].total) < 0.1);
      CHECK(found[k].first.value == Approx(first[k]).margin(0.01));
      CHECK(found[k].total.value == Approx(total[k]).margin(0.01));
    }
  }
}

TEST_CASE("Sobol' indices of the g-function are within their confidence") {
  // V_i = 1 / (3 (1 + a_i)^2), V = prod (1 + V_i) - 1, V_Ti = V_i prod_{j != i} (1 + V_j).
  double all = 1;
  for (const double a : kG) all *= 1 + 1 / (3 * (1 + a) * (1 + a));
  const double v = all - 1;
  const std::vector<SobolIndex> found = indices_of(4, 8192, 1, g_function);
  for (std::size_t k = 0; k < kG.size(); ++k) {
    const double v_k = 1 / (3 * (1 + kG[k]) * (1 + kG[k]));
    INFO("input " << k);
    CHECK(holds(found[k].first, v_k / v));
    CHECK(holds(found[k].total, v_k * all / (1 + v_k) / v));
    CHECK(width(found[k].total) < 0.06);
  }
}

TEST_CASE("indices of an output that does not vary are not numbers") {
  const std::vector<SobolIndex> found = indices_of(2, 16, 1, [](const VectorXd&) { return 3.0; });
  CHECK(std::isnan(found[0].first.value));
  CHECK(std::isnan(found[1].total.value));
}

TEST_CASE("Shapley effects of correlated inputs are within their confidence") {
  // y = b1 z1 + b2 z2 + b3 z3 with z3 independent. Shapley effects of the two correlated inputs,
  // Owen and Prieur (2017): b_i^2 (1 - r^2 / 2) + b_j^2 r^2 / 2 + b1 b2 r.
  constexpr double kR = 0.7;
  constexpr double b[] = {2, 1, 0.5};
  SweepSection sweep;
  sweep.parameters.resize(3);
  sweep.correlations = {{{0, 1}, kR}};
  const Correlation correlation(sweep);
  const auto linear = [&](const VectorXd& u) {
    double y = 0;
    for (Index k = 0; k < 3; ++k) y += b[k] * normal_quantile(u[k]);
    return y;
  };
  const double v = b[0] * b[0] + b[1] * b[1] + 2 * kR * b[0] * b[1] + b[2] * b[2];
  const auto pair = [&](double own, double other) {
    return own * own * (1 - kR * kR / 2) + other * other * kR * kR / 2 + own * other * kR;
  };
  const double truth[] = {pair(b[0], b[1]) / v, pair(b[1], b[0]) / v, b[2] * b[2] / v};
  constexpr std::uint64_t kSamples = 4000;
  const ShapleyPoints points(3, 1, correlation);
  REQUIRE(points.rows_per_sample() == 7);
  std::vector<std::uint64_t> samples(kSamples);
  for (std::uint64_t k = 0; k < kSamples; ++k) samples[k] = k;
  const std::vector<Estimate> found = shapley_effects(
      values_of(
          7, kSamples, [&](std::uint64_t row) { return points.point(row); }, linear),
      samples, points, 1);
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    INFO("input " << k);
    CHECK(holds(found[k], truth[k]));
    CHECK(width(found[k]) < 0.12);
    sum += found[k].value;
  }
  CHECK(sum == Approx(1).epsilon(1e-12));
}

TEST_CASE("rank correlation is that of ranks, with ties and rows that failed") {
  Eigen::MatrixXd inputs(3, 6);
  inputs << 1, 2, 3, 4, 5, 6,  //
      6, 5, 4, 3, 2, 1,        //
      1, 1, 2, 2, 7, 7;
  VectorXd output(6);
  output << 1, 10, 100, 1000, 10000, std::nan("");
  const VectorXd found = rank_correlations(inputs, output);
  CHECK(found[0] == Approx(1));
  CHECK(found[1] == Approx(-1));
  // Ranks 1.5 1.5 3.5 3.5 5 against 1 2 3 4 5: sums of squares 9 and 10, sum of products 9.
  CHECK(found[2] == Approx(9 / std::sqrt(90.0)));
}
