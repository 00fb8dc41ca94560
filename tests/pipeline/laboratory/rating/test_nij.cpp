// SPDX-License-Identifier: GPL-3.0-or-later
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "pipeline/laboratory/rating/nij.h"
#include "tests/pipeline/laboratory/rating/rated_signals.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::pipeline;
using Eigen::VectorXd;

namespace {

constexpr double kClosedForm = 1e-9;

std::array<NijPeak, 4> nij_of(const VectorXd& force_N, const VectorXd& moment_Nm,
                              const char* dummy = "50th-male") {
  return nij({force_N, moment_Nm, 1e-4}, neck_intercepts(dummy));
}

}  // namespace

TEST_CASE("Nij of constant loads, which a filter passes, is their sum over the intercepts") {
  const auto constant = [](double value) { return VectorXd(VectorXd::Constant(500, value)); };
  // Loads are half and a quarter of the intercepts, with the signs of each combination.
  const std::array<std::pair<double, double>, 4> loads = {{{6806 / 2.0, -135 / 4.0},
                                                           {6806 / 2.0, 310 / 4.0},
                                                           {-6160 / 2.0, -135 / 4.0},
                                                           {-6160 / 2.0, 310 / 4.0}}};
  for (std::size_t c = 0; c < loads.size(); ++c) {
    const auto peaks = nij_of(constant(loads.at(c).first), constant(loads.at(c).second));
    for (std::size_t other = 0; other < peaks.size(); ++other)
      CHECK(std::abs(peaks.at(other).value - (other == c ? 0.75 : 0)) < kClosedForm);
  }
  const auto small = nij_of(constant(4287), constant(-67), "5th-female");
  CHECK(small[0].name == "NTE");
  CHECK(std::abs(small[0].value - 2) < kClosedForm);
  CHECK(std::abs(nij_of(constant(-3880), constant(155), "5th-female")[3].value - 2) < kClosedForm);
}

TEST_CASE("Nij of a slow swing takes each combination in its quarter") {
  // The force is a cosine and the moment a sine of the same angle, one turn in 0.4 s: in its
  // quarter F cos + M sin is at most sqrt(a^2 + b^2), with a and b the amplitudes over the
  // intercepts. CFC 600 passes 2.5 Hz.
  const VectorXd angle = VectorXd::LinSpaced(4001, 0, 2 * std::numbers::pi);
  const auto peaks = nij_of(1000 * angle.array().cos(), 40 * angle.array().sin());
  const std::array<double, 4> expected = {
      std::hypot(1000 / 6806.0, 40 / 135.0), std::hypot(1000 / 6806.0, 40 / 310.0),
      std::hypot(1000 / 6160.0, 40 / 135.0), std::hypot(1000 / 6160.0, 40 / 310.0)};
  for (std::size_t c = 0; c < peaks.size(); ++c) {
    INFO(peaks.at(c).name);
    // Samples lie up to 0.8 mrad from the peak.
    CHECK(std::abs(peaks.at(c).value - expected.at(c)) < 1e-6);
    CHECK(peaks.at(c).force_N == Approx(1000 * std::cos(angle[peaks.at(c).sample])).margin(0.01));
  }
}

TEST_CASE("Nij filters with CFC 600, whose gain is one half at 2.0775 times 600 Hz") {
  const double turn = 2 * std::numbers::pi * 2.0775 * 600 * 1e-5;
  const VectorXd angle = VectorXd::LinSpaced(20001, 0, 20000 * turn);
  // In the middle of a slow swell the moment is half of 135 N m, and the force half of 6806 N.
  const VectorXd wave = testing::pulse(20001, 0, 20000).array() * angle.array().cos();
  const auto peaks = nij({6806 * wave, -135 * wave, 1e-5}, neck_intercepts("50th-male"));
  CHECK(peaks[0].value == Approx(1).epsilon(0.005));
}

TEST_CASE("the moment at the condyles is that of the load cell less the arm times the shear") {
  const VectorXd moment =
      condyle_moment(VectorXd::Constant(3, 1000), VectorXd::Constant(3, 50), 0.01778);
  CHECK(moment[1] == Approx(50 - 17.78));
  CHECK_THROWS_AS(condyle_moment(VectorXd::Zero(2), VectorXd::Zero(3), 0.01778), InputError);
}

TEST_CASE("Nij refuses loads that cannot be filtered") {
  const VectorXd load = VectorXd::Constant(100, 1.0);
  const NeckIntercepts& dummy = neck_intercepts("50th-male");
  CHECK_THROWS_WITH(nij({load, load, 2e-4}, dummy), Contains("6000 samples per second"));
  CHECK_THROWS_AS(nij({load, load.head(99), 1e-4}, dummy), InputError);
  VectorXd broken = load;
  broken[3] = std::nan("");
  CHECK_THROWS_AS(nij({load, broken, 1e-4}, dummy), InputError);
  CHECK_THROWS_WITH(neck_intercepts("50th-mal"), Contains("50th-male"));
}
