// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdlib>
#include <filesystem>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "pipeline/laboratory/rating/curve_pair.h"
#include "pipeline/laboratory/rating/iso18571.h"
#include "pipeline/laboratory/rating/resampling.h"
#include "tests/pipeline/laboratory/rating/plain_ratings.h"
#include "tests/pipeline/laboratory/rating/rated_signals.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::pipeline;
using namespace flexneck::testing;
using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double kClosedForm = 1e-6;       // for constructed signals
constexpr double kImplementations = 1e-9;  // for two that add in different order

void check_agree(const VectorXd& reference, const VectorXd& computed) {
  const Iso18571Rating rating = rate_iso18571(reference, computed);
  const PlainIso18571 plain = plain_iso18571(samples(reference), samples(computed));
  CHECK(rating.shift == plain.shift);
  CHECK(std::abs(rating.corridor - plain.corridor) < kImplementations);
  CHECK(std::abs(rating.phase - plain.phase) < kImplementations);
  CHECK(std::abs(rating.magnitude - plain.magnitude) < kImplementations);
  CHECK(std::abs(rating.slope - plain.slope) < kImplementations);
  CHECK(std::abs(rating.overall - plain.overall) < kImplementations);
}

}  // namespace

TEST_CASE("ISO/TS 18571 gives a curve that is compared with itself 1 in every part") {
  std::mt19937 random(1);
  // A sine of many periods also fits when shifted by a period: the shift by the fewest samples
  // counts.
  for (const VectorXd& curve : {sine(600, 10), sine(401, 7.5), flat_ramp(200), pulse(300, 40, 190),
                                random_smooth(500, random)}) {
    for (const double unit : {1.0, 1e-200, -3e200}) {
      const Iso18571Rating rating = rate_iso18571(unit * curve, unit * curve);
      CHECK(rating.shift == 0);
      CHECK(rating.corridor == 1);
      CHECK(rating.phase == 1);
      CHECK(rating.magnitude == 1);
      CHECK(rating.slope == 1);
      CHECK(rating.overall == Approx(1).margin(kClosedForm));
    }
  }
}

TEST_CASE("ISO/TS 18571 of a constant offset") {
  // T is 1 except for the flat ramp, the largest |T| is N, C = T + d: all distances are d, and so
  // are all differences on the diagonal. The slopes are equal, and so is the shape.
  const VectorXd reference = flat_ramp(100);
  const double norm = reference.maxCoeff();
  for (const double offset : {0.04, 0.1, 0.2, -0.3, 0.6}) {
    const VectorXd computed = reference.array() + offset;
    const Iso18571Rating rating = rate_iso18571(reference, computed);
    const double distance = std::abs(offset) / norm;
    const double between = distance < 0.05 ? 1 : distance > 0.5 ? 0 : (0.5 - distance) / 0.45;
    CHECK(std::abs(rating.corridor - between * between) < kClosedForm);
    CHECK(rating.shift == 0);
    CHECK(rating.phase == 1);
    CHECK(rating.correlation == Approx(1).margin(kClosedForm));
    const double error = 100 * std::abs(offset) / reference.sum();
    CHECK(std::abs(rating.magnitude_error - error) < kClosedForm);
    CHECK(std::abs(rating.magnitude - std::max(0.0, 1 - 2 * error)) < kClosedForm);
    CHECK(rating.slope == Approx(1).margin(kClosedForm));
  }
}

TEST_CASE("ISO/TS 18571 of a scaled amplitude") {
  for (const double more : {0.02, 0.1, 0.3, -0.2, -0.4}) {
    // C = (1 + q) T: distances q T, magnitude error q on the diagonal, slope error q.
    const VectorXd reference = flat_ramp(100);
    const Iso18571Rating rating = rate_iso18571(reference, (1 + more) * reference);
    const double q = std::abs(more);
    double corridor = 0;
    for (const double value : reference)
      corridor += std::pow(std::min(1.0, (0.5 - q * value / reference.maxCoeff()) / 0.45), 2);
    CHECK(std::abs(rating.corridor - corridor / 100) < kClosedForm);
    CHECK(rating.phase == 1);
    CHECK(std::abs(rating.magnitude - (1 - 2 * q)) < kClosedForm);
    CHECK(std::abs(rating.slope - (1 - q / 2)) < kClosedForm);
    // The slope rating is the same for any curve compared with a multiple of itself.
    const VectorXd wave = sine(500, 2);
    CHECK(std::abs(rate_iso18571(wave, (1 + more) * wave).slope - (1 - q / 2)) < kClosedForm);
  }
}

TEST_CASE("ISO/TS 18571 of a pure shift") {
  // A pulse that is zero at both ends: after the shift the curves are equal.
  constexpr Index kCount = 1000;
  const VectorXd reference = pulse(kCount, 250, 700);
  for (const int late : {0, 1, 7, -7, 60, -150, 199}) {
    const VectorXd computed = pulse(kCount, 250 + late, 700 + late);
    const Iso18571Rating rating = rate_iso18571(reference, computed);
    INFO(late);
    CHECK(rating.shift == late);
    CHECK(std::abs(rating.phase - (1 - std::abs(late) / 200.0)) < kClosedForm);
    CHECK(std::abs(rating.magnitude - 1) < kClosedForm);
    CHECK(std::abs(rating.slope - 1) < kClosedForm);
  }
  // At a fifth of the length the phase rating is zero, and shifts do not exceed it.
  CHECK(rate_iso18571(reference, pulse(kCount, 450, 900)).phase == 0);
  CHECK(rate_iso18571(reference, pulse(kCount, 500, 950)).shift == 200);
}

TEST_CASE("two implementations of ISO/TS 18571 agree") {
  std::mt19937 random(18571);
  for (int repeat = 0; repeat < 60; ++repeat) {
    const Index count = 100 + 7 * repeat;
    const VectorXd reference = random_smooth(count, random);
    CAPTURE(repeat, count);
    check_agree(reference, reference + 0.3 * random_smooth(count, random));
    check_agree(1e6 * reference, 1e6 * random_smooth(count, random));
  }
}

TEST_CASE("two implementations of ISO/TS 18571 agree where ties are many") {
  std::mt19937 random(3);
  for (int repeat = 0; repeat < 40; ++repeat) {
    const Index count = 120 + 11 * repeat;
    CAPTURE(repeat, count);
    // The curves have few levels, exact in binary: plateaus on which many paths cost the same.
    const VectorXd reference = (2 * random_smooth(count, random).array()).round().matrix() / 4;
    const VectorXd computed = (2 * random_smooth(count, random).array()).round().matrix() / 4;
    check_agree(reference, computed);
    check_agree(pulse(count, 30, 70), pulse(count, 35, 95));
  }
}

TEST_CASE("ISO/TS 18571 of curves that have little to do with each other stays within 0 and 1") {
  const VectorXd reference = pulse(400, 50, 300);
  VectorXd spikes = VectorXd::Zero(400);
  spikes[200] = 1e300;
  const VectorXd alternating =
      VectorXd::NullaryExpr(400, [](Index k) { return k % 2 == 0 ? 1.0 : -1.0; });
  for (const VectorXd& computed : {VectorXd(-reference), spikes, VectorXd(-spikes), alternating,
                                   VectorXd(1e-300 * reference), VectorXd(1e300 * reference)}) {
    for (const bool is_turned : {false, true}) {
      const Iso18571Rating rating =
          is_turned ? rate_iso18571(computed, reference) : rate_iso18571(reference, computed);
      for (const double part :
           {rating.corridor, rating.phase, rating.magnitude, rating.slope, rating.overall}) {
        CHECK(part >= 0);
        CHECK(part <= 1);
      }
      CHECK(std::abs(rating.correlation) <= 1 + 1e-9);
    }
  }
  CHECK(rate_iso18571(reference, 1e300 * reference).magnitude == 0);
}

TEST_CASE("ISO/TS 18571 rates the longest curves in little memory") {
  // A square matrix of these would take 80 GB.
  const VectorXd reference = pulse(40'000, 3000, 30'000);
  CHECK(rate_iso18571(reference, 1.1 * reference).overall > 0.8);
}

TEST_CASE("ISO/TS 18571 refuses what cannot be rated") {
  const VectorXd wave = sine(200, 2);
  CHECK_THROWS_WITH(rate_iso18571(wave, sine(201, 2)), Contains("200 and 201 samples"));
  CHECK_THROWS_WITH(rate_iso18571(sine(99, 2), sine(99, 2)), Contains("at least 100"));
  const VectorXd longest = sine(kMaxRatedSamples + 1, 2);
  CHECK_THROWS_WITH(rate_iso18571(longest, longest), Contains("at most 100000"));
  CHECK_THROWS_WITH(rate_iso18571(VectorXd::Zero(200), wave), Contains("reference curve is const"));
  CHECK_THROWS_WITH(rate_iso18571(VectorXd::Constant(200, 3), wave), Contains("constant (3"));
  CHECK_THROWS_WITH(rate_iso18571(wave, VectorXd::Zero(200)), Contains("computed curve is const"));
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    VectorXd broken = wave;
    broken[17] = bad;
    CHECK_THROWS_WITH(rate_iso18571(broken, wave), Contains("reference curve has a value"));
    CHECK_THROWS_AS(rate_iso18571(wave, broken), InputError);
  }
}

TEST_CASE("ISO/TS 18571 rates the pair of another program as it does") {
  // Public sample of Y. Park's ISO18571 (MIT); the ratings are those of a Python reference.
  const char* const samples_folder = std::getenv("FLEXNECK_SAMPLES");
  if (samples_folder == nullptr) {
    WARN("not compared with another program: FLEXNECK_SAMPLES names no folder with iso18571/");
    return;
  }
  const std::filesystem::path folder = std::filesystem::path(samples_folder) / "iso18571";
  const ResampledPair pair = resampled(read_curve(folder / "reference.csv", ""),
                                       read_curve(folder / "comparison.csv", ""), {});
  const Iso18571Rating rating = rate_iso18571(pair.reference, pair.computed);
  constexpr double kRoundedTo = 1e-6;
  CHECK_FALSE(pair.is_interpolated);
  CHECK(pair.reference.size() == 600);
  CHECK(std::abs(rating.corridor - 0.652891) < kRoundedTo);
  CHECK(std::abs(rating.phase - 0.941667) < kRoundedTo);
  CHECK(std::abs(rating.magnitude - 0.950654) < kRoundedTo);
  CHECK(std::abs(rating.slope - 0.956687) < kRoundedTo);
  CHECK(std::abs(rating.overall - 0.830958) < kRoundedTo);
  CHECK(rating.shift == 7);
  CHECK(std::abs(rating.correlation - 0.999766) < kRoundedTo);
  check_agree(pair.reference, pair.computed);
}
