// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "multibody/numerics/smooth_motion.h"

using flexneck::InputError;
using flexneck::multibody::SmoothMotion;

namespace {

constexpr double kRate = 2 * std::numbers::pi * 7;

}  // namespace

TEST_CASE("a displacement given by a function has its exact velocity and acceleration") {
  const auto motion = SmoothMotion::of_displacement(
      [](double t) { return 0.05 * std::sin(kRate * t) * std::exp(-t); }, 2.0);
  CHECK(motion.breakpoints_s().empty());
  for (const double t : {0.0, 0.123, 0.5, 1.0, 1.999, 2.0}) {
    const double s = std::sin(kRate * t);
    const double c = std::cos(kRate * t);
    const double size = 0.05 * std::exp(-t);
    CHECK(motion.displacement_m(t) == Approx(size * s).margin(1e-14));
    CHECK(motion.velocity_m_s(t) == Approx(size * (kRate * c - s)).margin(1e-11));
    CHECK(motion.acceleration_m_s2(t) ==
          Approx(size * ((1 - kRate * kRate) * s - 2 * kRate * c)).margin(1e-7));
  }
}

TEST_CASE("a bump that is short beside the run is a smooth displacement") {
  // Times are rounded to 4e-15 s, which hides where the bump begins and ends by 6e-9 s: there the
  // value has changed by 1.1e-9 of its largest.
  constexpr double kPi = std::numbers::pi;
  constexpr double kBegin = 1.731, kLength = 0.0006, kEnd = 17, kSize = 2.3483797431047226e-05;
  const auto motion = SmoothMotion::of_displacement(
      [](double t) {
        const double x = (t - kBegin) / kLength;
        return t > kBegin && t < kBegin + kLength ? kSize * (1 - std::cos(2 * kPi * x)) / 2 : 0.0;
      },
      kEnd);
  const double steepest_m_s = kPi * kSize / kLength;
  CHECK(motion.velocity_m_s(kBegin + kLength / 4) == Approx(steepest_m_s).epsilon(1e-7));
  CHECK(motion.velocity_m_s(kBegin + 3 * kLength / 4) == Approx(-steepest_m_s).epsilon(1e-7));
  CHECK(motion.displacement_m(kBegin + 2 * kLength) == 0);
}

TEST_CASE("an acceleration given by a function has its exact integrals, past kinks and jumps") {
  // Half a sine, then zero: a kink at 80 ms. Then a step at a time that halving never reaches.
  constexpr double kEnd = 0.08;
  constexpr double kJump = 0.1234567;
  const auto motion = SmoothMotion::of_acceleration(
      [](double t) {
        const double sine = t < kEnd ? -200 * std::sin(std::numbers::pi * t / kEnd) : 0;
        return sine + (t >= kJump ? 30 : 0);
      },
      0.3);
  REQUIRE(motion.breakpoints_s().size() == 2);
  CHECK(motion.breakpoints_s()[0] == Approx(kEnd).margin(1e-8));
  CHECK(motion.breakpoints_s()[1] == Approx(kJump).epsilon(1e-15));
  CHECK(motion.velocity_m_s(0) == Approx(0).margin(1e-14));
  const double lost = -200 * 2 * kEnd / std::numbers::pi;
  CHECK(motion.velocity_m_s(0.1) == Approx(lost).epsilon(1e-13));
  CHECK(motion.velocity_m_s(0.3) == Approx(lost + 30 * (0.3 - kJump)).epsilon(1e-13));
  // The displacement at the end of half a sine is half of that at its final velocity.
  CHECK(motion.displacement_m(0.3) ==
        Approx(lost * (0.3 - kEnd / 2) + 15 * std::pow(0.3 - kJump, 2)).epsilon(1e-13));
  CHECK(motion.acceleration_m_s2(0.04) == Approx(-200).epsilon(1e-13));
}

TEST_CASE("no feature longer than the resolution vanishes, wherever it is in a long run") {
  constexpr double kPi = std::numbers::pi;
  for (const double end : {0.3, 60.0, 600.0})
    for (const double start : {0.0, 0.1, 0.46, 0.77777, 0.999})
      for (const double length : {1e-4, 3e-3, 0.05, 0.08}) {
        if (end > 100 && start != 0.77777) continue;  // half a second each
        const double begin = start * (end - length);
        INFO(length << " s at " << begin << " s of " << end << " s");
        const auto inside = [=](double t) { return t > begin && t < begin + length; };
        const auto sine = [=](double t) {
          return inside(t) ? -100 * std::sin(kPi * (t - begin) / length) : 0;
        };
        // Rounding of the times of 600 s is 1e-9 of 0.1 ms.
        CHECK(SmoothMotion::of_acceleration(sine, end).velocity_m_s(end) ==
              Approx(-200 * length / kPi).epsilon(3e-9));
        const auto box = [=](double t) { return inside(t) ? 7.0 : 0.0; };
        CHECK(SmoothMotion::of_acceleration(box, end).velocity_m_s(end) ==
              Approx(7 * length).epsilon(3e-9));
        // Its acceleration jumps at both ends; for shorter ones rounding of the times hides the
        // size of the jump.
        if (length < 1e-3 || end > 100) continue;
        const auto bump = [=](double t) {
          return inside(t) ? 0.01 * (1 - std::cos(2 * kPi * (t - begin) / length)) / 2 : 0;
        };
        const auto motion = SmoothMotion::of_displacement(bump, end);
        const double rate = 2 * kPi / length;
        CHECK(motion.velocity_m_s(begin + length / 4) == Approx(0.005 * rate).epsilon(1e-7));
        CHECK(motion.acceleration_m_s2(begin + length / 2) ==
              Approx(-0.005 * rate * rate).epsilon(1e-5));
        const auto& breaks = motion.breakpoints_s();
        for (const double time : breaks)
          CHECK(std::abs(motion.acceleration_m_s2(time)) < 0.00501 * rate * rate);
      }
}

TEST_CASE("shorter features are found between breakpoints, or at a finer resolution") {
  constexpr double kBegin = 0.3;
  constexpr double kEnd = 0.300001;
  const auto blow = [](double t) { return t > kBegin && t < kEnd ? 1e6 : 0; };
  const double gained = 1e6 * (kEnd - kBegin);
  const auto declared = SmoothMotion::of_acceleration(
      blow, 1, {.resolution_s = 1e-4, .breakpoints_s = {kBegin, kEnd}});
  CHECK(declared.velocity_m_s(1) == Approx(gained).epsilon(1e-13));
  CHECK(SmoothMotion::of_acceleration(blow, 1, {.resolution_s = 1e-6}).velocity_m_s(1) ==
        Approx(gained).epsilon(1e-9));
  CHECK_THROWS_WITH(
      SmoothMotion::of_acceleration(blow, 1, {.resolution_s = 1e-4, .breakpoints_s = {0.3, 0.2}}),
      Catch::Matchers::Contains("breakpoints must increase"));
  CHECK_THROWS_WITH(SmoothMotion::of_acceleration(blow, 1e5),
                    Catch::Matchers::Contains("increase solver.resolution"));
}

TEST_CASE("a motion that is not smooth enough or not a number is refused") {
  using Catch::Matchers::Contains;
  CHECK_THROWS_WITH(SmoothMotion::of_displacement([](double t) { return std::abs(t - 0.3); }, 1.0),
                    Contains("must be smooth"));
  CHECK_THROWS_WITH(SmoothMotion::of_acceleration([](double t) { return std::sqrt(t - 0.5); }, 1.0),
                    Contains("is not a finite number at"));
  CHECK_THROWS_WITH(SmoothMotion::of_acceleration([](double t) { return 1 / t; }, 1.0),
                    Contains("is not a finite number at 0 s"));
  CHECK_THROWS_WITH(SmoothMotion::of_acceleration([](double t) { return 1 / (t - 0.5); }, 1.0),
                    Contains("is not piecewise smooth, e.g. at 0.5 s"));
  CHECK_THROWS_WITH(SmoothMotion::of_acceleration([](double t) { return 1 / (t - 0.25); }, 1.0),
                    Contains("is not piecewise smooth, e.g. at 0.2"));
  // Halving reaches this one exactly.
  CHECK_THROWS_AS(SmoothMotion::of_displacement([](double t) { return std::abs(t - 0.5); }, 1.0),
                  InputError);
  const auto step =
      SmoothMotion::of_acceleration([](double t) { return t < 0.5 ? 1.0 : 2.0; }, 1.0);
  CHECK(step.breakpoints_s() == std::vector<double>{0.5});
  const SmoothMotion none;
  CHECK(none.displacement_m(3) == 0);
}

TEST_CASE("the spline through a table of displacements is exact for a cubic and of order four") {
  const auto cubic = [](double t) { return 1 + t * (2 + t * (-3 + 4 * t)); };
  const std::vector<double> times = {0, 0.1, 0.35, 0.4, 0.8, 1.0};
  std::vector<double> values;
  for (const double t : times) values.push_back(cubic(t));
  const auto motion = SmoothMotion::of_displacement_table(times, values);
  for (const double t : {0.0, 0.05, 0.2, 0.39, 0.77, 1.0}) {
    CHECK(motion.displacement_m(t) == Approx(cubic(t)).epsilon(1e-13));
    CHECK(motion.velocity_m_s(t) == Approx(2 + t * (-6 + 12 * t)).epsilon(1e-12));
    CHECK(motion.acceleration_m_s2(t) == Approx(-6 + 24 * t).margin(1e-11));
  }
  CHECK(motion.breakpoints_s() == std::vector<double>{0.35, 0.4});

  // Its fourth derivative is not zero at the ends, where the spline is worst.
  const auto wave = [](double t) { return std::cos(kRate * t); };
  const auto error = [&](int rows, bool of_acceleration) {
    std::vector<double> t;
    std::vector<double> y;
    for (int k = 0; k < rows; ++k) {
      t.push_back(static_cast<double>(k) / (rows - 1));
      y.push_back(wave(t.back()));
    }
    const auto spline = SmoothMotion::of_displacement_table(t, y);
    double largest = 0;
    for (int k = 0; k <= 1000; ++k) {
      const double at = k / 1000.0;
      largest =
          std::max(largest, of_acceleration
                                ? std::abs(spline.acceleration_m_s2(at) + kRate * kRate * wave(at))
                                : std::abs(spline.displacement_m(at) - wave(at)));
    }
    return largest;
  };
  CHECK(std::log2(error(201, false) / error(401, false)) == Approx(4).margin(0.2));
  CHECK(std::log2(error(201, true) / error(401, true)) == Approx(2).margin(0.2));
}

TEST_CASE("tables of displacements that no spline goes through are refused") {
  using Catch::Matchers::Contains;
  CHECK_THROWS_WITH(SmoothMotion::of_displacement_table({0, 1, 2}, {0, 0, 0}),
                    Contains("at least four rows"));
  CHECK_THROWS_WITH(SmoothMotion::of_displacement_table({0, 1, 1, 2}, {0, 0, 0, 0}),
                    Contains("do not increase, at 1 s"));
  CHECK_THROWS_WITH(SmoothMotion::of_displacement_table({0, 1, 2, 3}, {0, 0, std::nan(""), 0}),
                    Contains("is not a finite number at 2 s"));
}
