// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "multibody/signals/response.h"

using namespace flexneck::multibody;
using Eigen::VectorXd;

namespace {

constexpr double kPi = std::numbers::pi;

VectorXd millisecond_grid(Eigen::Index count) {
  return VectorXd::LinSpaced(count, 0, 1e-3 * static_cast<double>(count - 1));
}

/// Signal level + exp(-zeta w t) cos(wd t + phase).
VectorXd damped_wave(const VectorXd& time_s, double frequency_Hz, double zeta, double phase,
                     double level) {
  const double w = 2 * kPi * frequency_Hz;
  const double wd = w * std::sqrt(1 - zeta * zeta);
  return level + (-zeta * w * time_s.array()).exp() * (wd * time_s.array() + phase).cos();
}

}  // namespace

TEST_CASE("Frequency and damping of a damped wave sampled at 1 ms come back") {
  const double zeta = GENERATE(0.0, 0.05, 0.128, 0.3);
  const double phase = GENERATE(0.0, 1.0, 4.0);
  const double after_s = GENERATE(0.0, 0.0371);
  const double sign = GENERATE(1.0, -1.0);
  const double frequency_Hz = 5.2;
  const VectorXd time_s = millisecond_grid(1001);
  const VectorXd signal = sign * damped_wave(time_s, frequency_Hz, zeta, phase, 0.4);
  const FreeOscillation found = free_oscillation(time_s, signal, sign * 0.4, after_s);
  // Interpolation between samples 1 ms apart, 0.03 rad of this wave, errs by less than this.
  constexpr double kTolerance = 1e-4;
  REQUIRE(cycle_frequency_Hz(found));
  REQUIRE(cycle_damping_ratio(found));
  CHECK(*cycle_frequency_Hz(found) ==
        Approx(frequency_Hz * std::sqrt(1 - zeta * zeta)).epsilon(kTolerance));
  CHECK(*cycle_damping_ratio(found) == Approx(zeta).epsilon(kTolerance).margin(1e-6));
  CHECK(found.crossings_s.front() >= after_s - 1e-3);
}

TEST_CASE("A ripple on the half waves adds no peaks") {
  const VectorXd time_s = millisecond_grid(1001);
  const VectorXd wave = damped_wave(time_s, 5, 0.1, 0.5, 0);
  const VectorXd ripple = 0.02 * wave.array().abs() * (2 * kPi * 80 * time_s.array()).sin();
  const FreeOscillation smooth = free_oscillation(time_s, wave, 0, 0);
  const FreeOscillation rippled = free_oscillation(time_s, wave + ripple, 0, 0);
  CHECK(rippled.peaks.size() == smooth.peaks.size());
  CHECK(rippled.crossings_s.size() == smooth.crossings_s.size());
}

TEST_CASE("The peak of a half wave is its own, however large the next one begins") {
  const VectorXd time_s = VectorXd::LinSpaced(7, 0, 6);
  VectorXd signal(7);
  signal << 1, 3, 1, -9, -2, -1, 5;
  const FreeOscillation found = free_oscillation(time_s, signal, 0, 0);
  REQUIRE(found.peaks.size() >= 2);
  CHECK(found.peaks[0].value == Approx(3));
  CHECK(found.peaks[0].time_s == Approx(1));
  CHECK(found.peaks[1].value == Approx(-9.066).epsilon(1e-3));
}

TEST_CASE("Signals that do not oscillate have neither frequency nor damping") {
  const VectorXd time_s = millisecond_grid(500);
  const VectorXd decay = (-10 * time_s.array()).exp();
  const VectorXd constant = VectorXd::Constant(time_s.size(), 0.25);
  const VectorXd one_swing = damped_wave(time_s.head(150), 5, 0.1, 0, 0);
  for (const auto& [signal, level] : {std::pair(decay, 0.0), std::pair(constant, 0.25),
                                      std::pair(constant, 0.0), std::pair(one_swing, 0.0)}) {
    const FreeOscillation found = free_oscillation(time_s.head(signal.size()), signal, level, 0);
    CHECK_FALSE(cycle_frequency_Hz(found));
    CHECK_FALSE(cycle_damping_ratio(found));
  }
  const FreeOscillation later = free_oscillation(time_s, damped_wave(time_s, 5, 0.1, 0, 0), 0, 9);
  CHECK(later.crossings_s.empty());
  CHECK(later.peaks.empty());
}

TEST_CASE("A sample that lies on the equilibrium is one crossing") {
  const VectorXd time_s = VectorXd::LinSpaced(9, 0, 8);
  VectorXd signal(9);
  signal << 1, 0, -1, 0, 0, 1, 0, -1, -2;
  const FreeOscillation found = free_oscillation(time_s, signal, 0, 0);
  REQUIRE(found.crossings_s.size() == 3);
  CHECK(found.crossings_s[0] == Approx(1));
  CHECK(found.crossings_s[1] == Approx(4));
  CHECK(found.crossings_s[2] == Approx(6));
}

TEST_CASE("The largest peak is found with its sign, between samples and at the ends") {
  // -3 + 50 (t - 0.3217)^2, whose parabola is exact at any spacing.
  VectorXd time_s(6);
  time_s << 0.2, 0.25, 0.31, 0.33, 0.39, 0.45;
  const VectorXd valley = -3 + 50 * (time_s.array() - 0.3217).square();
  const Peak peak = largest_peak(time_s, valley);
  CHECK(peak.time_s == Approx(0.3217).epsilon(1e-10));
  CHECK(peak.value == Approx(-3).epsilon(1e-12));
  const Peak end = largest_peak(time_s, time_s);
  CHECK(end.time_s == 0.45);
  CHECK(end.value == 0.45);
}

TEST_CASE("Signals that are no signals are refused") {
  VectorXd time_s(3);
  time_s << 0, 1, 1;
  CHECK_THROWS_AS(largest_peak(time_s, VectorXd::Zero(3)), std::invalid_argument);
  CHECK_THROWS_AS(largest_peak(time_s.head(2), VectorXd::Zero(3)), std::invalid_argument);
  CHECK_THROWS_AS(largest_peak(VectorXd(), VectorXd()), std::invalid_argument);
  CHECK_THROWS_AS(largest_peak(time_s.head(2), VectorXd::Constant(2, NAN)), std::invalid_argument);
}
