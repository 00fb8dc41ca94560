// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "pipeline/laboratory/rating/cora.h"
#include "tests/pipeline/laboratory/rating/plain_ratings.h"
#include "tests/pipeline/laboratory/rating/rated_signals.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::pipeline;
using namespace flexneck::testing;
using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double kClosedForm = 1e-6;
constexpr double kImplementations = 1e-9;

}  // namespace

TEST_CASE("CORA gives a curve that is compared with itself 1 in every part") {
  std::mt19937 random(2);
  for (const VectorXd& curve :
       {sine(600, 10), flat_ramp(200), pulse(300, 40, 190), random_smooth(500, random)}) {
    for (const double unit : {1.0, 1e-200, -3e200}) {
      const CoraRating rating = rate_cora(unit * curve, unit * curve);
      CHECK(rating.shift == 0);
      CHECK(rating.corridor == 1);
      CHECK(std::abs(rating.progression - 1) < kClosedForm);
      CHECK(std::abs(rating.size - 1) < kClosedForm);
      CHECK(rating.phase == 1);
      CHECK(std::abs(rating.overall - 1) < kClosedForm);
    }
  }
}

TEST_CASE("CORA of a scaled amplitude: the size is the ratio of the squares") {
  const VectorXd wave = pulse(500, 80, 420);
  for (const double factor : {0.5, 0.9, 1.25, 2.0}) {
    const CoraRating rating = rate_cora(wave, factor * wave);
    CHECK(rating.shift == 0);
    CHECK(std::abs(rating.correlation - 1) < kClosedForm);
    CHECK(std::abs(rating.progression - 1) < kClosedForm);
    CHECK(std::abs(rating.energy_ratio - factor * factor) < kClosedForm);
    const double smaller = std::min(factor, 1 / factor);
    CHECK(std::abs(rating.size - smaller * smaller) < kClosedForm);
    CoraParameters squared;
    squared.size_exponent = 2;
    CHECK(std::abs(rate_cora(wave, factor * wave, squared).size - std::pow(smaller, 4)) <
          kClosedForm);
  }
}

TEST_CASE("CORA of a pure shift: the phase goes from 1 to 0 between D_MIN and D_MAX") {
  constexpr Index kCount = 1001;
  const VectorXd reference = pulse(kCount, 250, 700);
  for (const int late : {0, 9, 10, 11, -40, 65, -119, 120, 150}) {
    const CoraRating rating = rate_cora(reference, pulse(kCount, 250 + late, 700 + late));
    INFO(late);
    CHECK(rating.shift == late);
    // Fractions of the interval, which is 1000 steps long.
    const double phase = std::clamp((0.12 - std::abs(late) / 1000.0) / 0.11, 0.0, 1.0);
    CHECK(std::abs(rating.phase - phase) < kClosedForm);
    CHECK(std::abs(rating.progression - 1) < kClosedForm);
    CHECK(std::abs(rating.size - 1) < kClosedForm);
    CHECK(std::abs(rating.cross_correlation - (0.75 + 0.25 * phase)) < kClosedForm);
  }
}

TEST_CASE("CORA of the opposite has no progression") {
  const VectorXd reference = flat_ramp(300);
  const CoraRating rating = rate_cora(reference, -reference);
  // The correlation about zero is -1 at any shift.
  CHECK(std::abs(rating.correlation + 1) < 1e-4);
  CHECK(rating.progression < kClosedForm);
  CHECK(rating.corridor == 0);
  CHECK(std::abs(rating.size - 1) < 0.01);
}

TEST_CASE("two implementations of CORA agree") {
  std::mt19937 random(405);
  for (int repeat = 0; repeat < 60; ++repeat) {
    const Index count = 100 + 13 * repeat;
    const VectorXd reference = random_smooth(count, random);
    for (const VectorXd& computed :
         {VectorXd(reference + 0.3 * random_smooth(count, random)), random_smooth(count, random)}) {
      CAPTURE(repeat, count);
      const CoraRating rating = rate_cora(reference, computed);
      const PlainCora plain = plain_cora(samples(reference), samples(computed));
      CHECK(rating.shift == plain.shift);
      CHECK(std::abs(rating.corridor - plain.corridor) < kImplementations);
      CHECK(std::abs(rating.progression - plain.progression) < kImplementations);
      CHECK(std::abs(rating.size - plain.size) < kImplementations);
      CHECK(std::abs(rating.phase - plain.phase) < kImplementations);
      CHECK(std::abs(rating.overall - plain.overall) < kImplementations);
    }
  }
}

TEST_CASE("CORA finds its interval of evaluation") {
  // sin^2 reaches 0.03 at asin(sqrt(0.03)) / pi = 0.0554115 of the pulse, and 0.075 at 0.0883195
  // from its end: 100 + 800 * 0.0554 = 144.3 and 900 - 800 * 0.0883 = 829.3. Each end is then moved
  // outwards by 0.01 of the 684 samples between.
  const SampleRange range = cora_interval(pulse(1000, 100, 900));
  CHECK(range.first == 145 - 6);
  CHECK(range.last == 829 + 6);

  // With a constant last value the interval ends where the curve comes within 0.2 of it, at 0.8 of
  // a ramp from 100 to 600.
  VectorXd ramp = VectorXd::Ones(1000);
  for (Index k = 0; k < 1000; ++k)
    ramp[k] = std::clamp((static_cast<double>(k) - 100) / 500, 0.0, 1.0);
  CoraParameters no_extension;
  no_extension.extension = 0;
  const SampleRange shortened = cora_interval(-2 * ramp, no_extension);
  CHECK(shortened.first == 115);
  CHECK(std::abs(shortened.last - 500) <= 1);

  // The interval of a curve that hardly changes would be empty, so the whole curve is used.
  const SampleRange whole = cora_interval(flat_ramp(200));
  CHECK(whole.first == 0);
  CHECK(whole.last == 199);
}

TEST_CASE("CORA refuses parameters that make no sense") {
  const VectorXd wave = sine(200, 2);
  const auto refused = [&](auto change, const char* why) {
    CoraParameters parameters;
    change(parameters);
    CHECK_THROWS_WITH(rate_cora(wave, wave, parameters), Contains(why));
  };
  refused([](CoraParameters& p) { p.inner = 0.5; }, "a_0 < b_0");
  refused([](CoraParameters& p) { p.outer = std::nan(""); }, "a_0 < b_0");
  refused([](CoraParameters& p) { p.max_shift = 0.005; }, "D_MIN < D_MAX");
  refused([](CoraParameters& p) { p.min_overlap = 0; }, "INT_MIN");
  refused([](CoraParameters& p) { p.progression_exponent = 0; }, "exponents");
  refused([](CoraParameters& p) { p.size_weight = 0.5; }, "G_V + G_G + G_P = 1");
  refused(
      [](CoraParameters& p) {
        p.corridor_weight = 1.5;
        p.cross_correlation_weight = -0.5;
      },
      "not negative");
  CHECK_THROWS_AS(rate_cora(wave, VectorXd::Zero(200)), InputError);
}
