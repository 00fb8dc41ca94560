// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "multibody/time/dormand_prince.h"

using Eigen::VectorXd;
using namespace flexneck::multibody;
using Catch::Matchers::Contains;

namespace {

constexpr StepLimits kStepLimits{1.0, 1e-10};

/// s = exp(sin t) satisfies s'' = s'^2 / s - s sin t: nonlinear, and time-dependent too, so that no
/// order condition is satisfied by chance.
double exact(double t) { return std::exp(std::sin(t)); }
double exact_rate(double t) { return std::cos(t) * exact(t); }
void derivative(double t, const VectorXd& y, VectorXd& rate) {
  rate[0] = y[1];
  rate[1] = y[1] * y[1] / y[0] - std::sin(t) * y[0];
}

InitialValueProblem problem(double tolerance) {
  InitialValueProblem result;
  result.derivative = derivative;
  result.finish_step = derivative;
  result.measure = [tolerance](const VectorXd&, const VectorXd&, const VectorXd& error) {
    return ErrorEstimate{error.norm() / tolerance, 0};
  };
  result.name_of_component = [](std::size_t) { return std::string("swing"); };
  return result;
}

VectorXd start() { return Eigen::Vector2d(exact(0), exact_rate(0)); }

double error_at_end(int steps) {
  DormandPrince integrator(problem(1), kStepLimits, 0, start());
  for (int k = 0; k < steps; ++k) integrator.fixed_step(1.0 / steps);
  return std::abs(integrator.state()[0] - exact(1));
}

/// Largest error inside the first step.
double dense_error(double length) {
  DormandPrince integrator(problem(1), kStepLimits, 0, start());
  integrator.fixed_step(length);
  VectorXd y(2);
  double worst = 0;
  for (int k = 1; k < 10; ++k) {
    integrator.interpolate(0.1 * k * length, y);
    worst = std::max(worst, std::abs(y[0] - exact(0.1 * k * length)));
  }
  return worst;
}

}  // namespace

TEST_CASE("before the first step the dense output is the state at the start") {
  const DormandPrince integrator(problem(1), kStepLimits, 0.5, start());
  VectorXd y(2);
  integrator.interpolate(0.5, y);
  CHECK(y == start());
}

TEST_CASE("the integrator is of order five") {
  // Halving the step divides the error by 2^5, up to terms of the next order.
  const double order = std::log2(error_at_end(20) / error_at_end(40));
  CHECK(order == Approx(5).margin(0.25));
  CHECK(error_at_end(40) < 1e-8);
}

TEST_CASE("dense output is of order four") {
  // Inside one step the error falls with its length to the power 4 + 1.
  const double order = std::log2(dense_error(0.05) / dense_error(0.025));
  CHECK(order == Approx(5).margin(0.25));
}

TEST_CASE("dense output meets the ends of its step") {
  DormandPrince integrator(problem(1), kStepLimits, 0, start());
  integrator.fixed_step(0.1);
  const VectorXd before = integrator.state();
  integrator.fixed_step(0.2);
  VectorXd y(2);
  integrator.interpolate(0.1, y);
  CHECK((y - before).norm() < 1e-15);
  integrator.interpolate(integrator.time_s(), y);
  CHECK((y - integrator.state()).norm() < 1e-15);
}

TEST_CASE("the error follows the tolerance and the steps the error") {
  double previous_error = 1;
  for (const double tolerance : {1e-5, 1e-7, 1e-9, 1e-11}) {
    DormandPrince integrator(problem(tolerance), kStepLimits, 0, start());
    while (integrator.time_s() < 1.2) integrator.step(1.2);
    const double error = std::abs(integrator.state()[0] - exact(1.2));
    CHECK(integrator.time_s() == 1.2);
    CHECK(error < 20 * tolerance);
    CHECK(error < previous_error);
    // A method of order 5 needs tolerance^(-1/5) steps; far fewer than a fixed small step.
    CHECK(integrator.accepted() < 6 * std::pow(tolerance, -0.2));
    previous_error = error;
  }
}

TEST_CASE("a step cut short by a limit does not shrink the next one") {
  DormandPrince integrator(problem(1e-6), kStepLimits, 0, start());
  for (int k = 0; k < 10; ++k) integrator.step(1.0);
  const double at = integrator.time_s();
  integrator.step(at + 1e-7);
  integrator.step(3.0);
  CHECK(integrator.time_s() - at > 1e-3);
}

TEST_CASE("a solution that runs away stops with its time and what limits the step") {
  // y' = y^2 from 1: y = 1 / (1 - t).
  InitialValueProblem blow_up = problem(1e-6);
  blow_up.derivative = [](double, const VectorXd& y, VectorXd& rate) { rate = y.cwiseAbs2(); };
  blow_up.finish_step = [](double, VectorXd& y, VectorXd& rate) { rate = y.cwiseAbs2(); };
  blow_up.measure = [](const VectorXd& y, const VectorXd&, const VectorXd& error) {
    return ErrorEstimate{error.norm() / (1e-6 * y.norm()), 0};
  };
  DormandPrince integrator(blow_up, kStepLimits, 0, VectorXd::Ones(1));
  const auto run = [&] {
    while (integrator.time_s() < 2) integrator.step(2);
  };
  CHECK_THROWS_AS(run(), flexneck::ComputationError);
  CHECK(integrator.time_s() == Approx(1).margin(1e-6));
  CHECK_THROWS_WITH(integrator.step(2), Contains("swing") && Contains(" s;"));
}

TEST_CASE("a rate that is not a number stops the run instead of hanging it") {
  InitialValueProblem broken = problem(1e-6);
  const auto root = [](double t, const VectorXd&, VectorXd& rate) {
    rate.setConstant(std::sqrt(1 - t));
  };
  broken.derivative = root;
  broken.finish_step = root;
  DormandPrince integrator(broken, kStepLimits, 0, VectorXd::Ones(2));
  const auto run = [&] {
    while (integrator.time_s() < 2) integrator.step(2);
  };
  CHECK_THROWS_AS(run(), flexneck::ComputationError);
  CHECK(integrator.time_s() == Approx(1).margin(1e-3));

  DormandPrince from_nothing(problem(1e-6), kStepLimits, 0, VectorXd::Constant(2, std::nan("")));
  CHECK_THROWS_WITH(from_nothing.step(1), Contains("not a finite number"));
}
