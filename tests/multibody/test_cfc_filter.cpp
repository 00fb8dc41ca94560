// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "multibody/signals/cfc_filter.h"

using Catch::Matchers::Contains;
using Eigen::Index;
using Eigen::VectorXd;
using namespace flexneck::multibody;

namespace {

constexpr double kInterval_s = 1e-4;

VectorXd sine(double frequency_Hz, Index count) {
  const auto at = [&](Index k) {
    return std::sin(2 * std::numbers::pi * frequency_Hz * kInterval_s * static_cast<double>(k));
  };
  return VectorXd::NullaryExpr(count, at);
}

}  // namespace

TEST_CASE("a channel class damps a sine as its poles say and does not shift it") {
  const auto cfc = GENERATE(ChannelClass::cfc60, ChannelClass::cfc180, ChannelClass::cfc600,
                            ChannelClass::cfc1000);
  const double share = GENERATE(0.2, 1.0, 2.0775, 3.0);
  const double number = static_cast<double>(cfc);
  const double frequency_Hz = share * number;
  constexpr Index kCount = 8000;
  const VectorXd signal = sine(frequency_Hz, kCount);
  const VectorXd filtered = cfc_filtered(signal, kInterval_s, cfc);
  const double pi = std::numbers::pi;
  const double ratio =
      std::tan(pi * frequency_Hz * kInterval_s) / std::tan(pi * 2.0775 * number * kInterval_s);
  const double gain = 1 / (1 + std::pow(ratio, 4));
  // Effects of the ends have decayed half a record away from them.
  const auto middle = [](const VectorXd& v) { return v.segment(kCount / 2 - 500, 1000); };
  CHECK((middle(filtered) - gain * middle(signal)).lpNorm<Eigen::Infinity>() < 1e-9);
  if (share == 2.0775) CHECK(gain == Approx(0.5).epsilon(1e-12));
}

TEST_CASE("a channel class passes and damps as SAE J211 draws it") {
  // Limits of the standard's figure in dB: up to the class +0.5 and -1; at class / 0.6, which it
  // calls the cutoff, +0.5 and -4; an octave above that at most about -9 - 3: well below -12.
  const auto [cfc, cutoff_Hz] =
      GENERATE(table<ChannelClass, double>({{ChannelClass::cfc60, 100},
                                            {ChannelClass::cfc180, 300},
                                            {ChannelClass::cfc600, 1000},
                                            {ChannelClass::cfc1000, 1650}}));
  const auto gain_dB = [&, cfc = cfc](double frequency_Hz) {
    constexpr Index kCount = 8000;
    const VectorXd signal = sine(frequency_Hz, kCount);
    const VectorXd filtered = cfc_filtered(signal, kInterval_s, cfc);
    const double gain = filtered.segment(3500, 1000).dot(signal.segment(3500, 1000)) /
                        signal.segment(3500, 1000).squaredNorm();
    return 20 * std::log10(gain);
  };
  const double number = static_cast<double>(cfc);
  CHECK(gain_dB(number) > -1);
  CHECK(gain_dB(number) < 0.5);
  CHECK(gain_dB(cutoff_Hz) > -4);
  CHECK(gain_dB(cutoff_Hz) < -1);
  CHECK(gain_dB(2 * cutoff_Hz) < -12);
}

TEST_CASE("a channel class keeps a constant and a straight line up to the ends") {
  const VectorXd line = VectorXd::LinSpaced(500, -3, 9);
  CHECK((cfc_filtered(VectorXd::Constant(50, 7.5), kInterval_s, ChannelClass::cfc180).array() - 7.5)
            .abs()
            .maxCoeff() < 1e-12);
  // The filter starts as if the signal always had its first value: the error of that at the
  // record's ends has decayed over ten time constants, exp(-10 / sqrt 2).
  const double step = line[1] - line[0];
  CHECK((cfc_filtered(line, kInterval_s, ChannelClass::cfc600) - line).lpNorm<Eigen::Infinity>() <
        1e-2 * step);
}

TEST_CASE("a channel class refuses a record that is too coarse or not finite") {
  CHECK_THROWS_WITH(cfc_filtered(VectorXd::Ones(10), 1e-3, ChannelClass::cfc180),
                    Contains("1800 samples"));
  CHECK_THROWS_AS(cfc_filtered(VectorXd::Constant(10, NAN), kInterval_s, ChannelClass::cfc60),
                  flexneck::InputError);
  CHECK_THROWS_AS(cfc_filtered(VectorXd::Ones(1), kInterval_s, ChannelClass::cfc60),
                  flexneck::InputError);
}
