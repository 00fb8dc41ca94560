// SPDX-License-Identifier: GPL-3.0-or-later
// Signals whose characteristic values are known in closed form, by the rules of the shipped
// regulations.
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "geometry/foundation/units.h"
#include "pipeline/laboratory/verdict/response_rules.h"
#include "pipeline/language/study/regulation.h"

using namespace flexneck;
using namespace flexneck::pipeline;
using Eigen::VectorXd;

namespace {

constexpr double kDeg = std::numbers::pi / 180;
constexpr double kMs = 1e-3;
// Error of curves sampled at 0.1 ms and interpolated linearly, in the value's own SI unit.
constexpr double kSampling = 2e-6;

double lbf_ft() { return 1 / factor_from_si("N*m", "lbf*ft"); }

using Curve = std::function<double(double)>;

ResponseCurves curves(const Curve& rotation_rad, const Curve& moment_Nm, double end_s = 0.25) {
  ResponseCurves sampled;
  sampled.time_s =
      VectorXd::LinSpaced(static_cast<Eigen::Index>(std::lround(end_s / 1e-4)) + 1, 0, end_s);
  sampled.rotation_rad = sampled.time_s.unaryExpr(rotation_rad);
  sampled.moment_Nm = sampled.time_s.unaryExpr(moment_Nm);
  return sampled;
}

/// A sine with that first peak: it crosses zero at twice the time of the peak.
Curve sine(double peak, double at_s) {
  return [=](double t) { return peak * std::sin(std::numbers::pi / 2 * t / at_s); };
}

/// A curve that is linear between zero at time zero, a peak and a value at a later time, and
/// beyond.
Curve triangle(double peak, double at_s, double value, double later_s) {
  return [=](double t) {
    return t < at_s ? peak * t / at_s : peak + (value - peak) * (t - at_s) / (later_s - at_s);
  };
}

const JudgedFigure& figure(const std::vector<JudgedFigure>& figures, const std::string& name) {
  for (const JudgedFigure& each : figures)
    if (each.name == name) return each;
  throw std::runtime_error("no figure " + name);
}

void check(const std::vector<JudgedFigure>& figures, const std::string& name, double value,
           double half_corridors) {
  INFO(name);
  const JudgedFigure& found = figure(figures, name);
  REQUIRE(found.value);
  CHECK(*found.value == Approx(value).margin(kSampling));
  CHECK(*found.half_corridors() == Approx(half_corridors).margin(5e-3));
  CHECK(found.is_inside() == (std::abs(half_corridors) <= 1));
}

CertificationTest test_of(const char* name) { return shipped_test(name).test; }

}  // namespace

TEST_CASE("572.33 flexion: sines in their corridors, each figure in closed form") {
  const auto figures = judged_response(
      test_of("572.33 flexion"), curves(sine(71 * kDeg, 60.5 * kMs), sine(72.5 * lbf_ft(), .0525)));
  REQUIRE(figures.size() == 6);
  check(figures, "peak rotation", 71 * kDeg, 0);
  check(figures, "time of peak rotation", 60.5 * kMs, 0);
  check(figures, "first zero crossing", 121 * kMs, 0.5 / 7.5);
  check(figures, "peak moment", 72.5 * lbf_ft(), 0);
  check(figures, "time of peak moment", 52.5 * kMs, 0);
  check(figures, "time of moment decay", 105 * kMs, 3.0 / 5);
}

TEST_CASE("572.33 extension: moments are negative, rotations those of the direction of flight") {
  const auto figures =
      judged_response(test_of("572.33 extension"),
                      curves(sine(93.5 * kDeg, 77 * kMs), sine(-49 * lbf_ft(), 70 * kMs)));
  check(figures, "peak rotation", 93.5 * kDeg, 0);
  check(figures, "time of peak rotation", 77 * kMs, 0);
  check(figures, "first zero crossing", 154 * kMs, -6.5 / 13.5);
  check(figures, "peak moment", -49 * lbf_ft(), 0);
  check(figures, "time of peak moment", 70 * kMs, -2.0 / 7);
  check(figures, "time of moment decay", 140 * kMs, 6.0 / 14);
}

TEST_CASE("572.33: what is outside says on which side and how far") {
  const auto figures =
      judged_response(test_of("572.33 flexion"),
                      curves(sine(53.5 * kDeg, 67.5 * kMs), sine(46.25 * lbf_ft(), 44.5 * kMs)));
  check(figures, "peak rotation", 53.5 * kDeg, -2.5);
  check(figures, "time of peak rotation", 67.5 * kMs, 2);
  check(figures, "first zero crossing", 135 * kMs, 14.5 / 7.5);
  check(figures, "peak moment", 46.25 * lbf_ft(), -3.5);
  check(figures, "time of peak moment", 44.5 * kMs, -8 / 5.5);
  check(figures, "time of moment decay", 89 * kMs, -13.0 / 5);
}

TEST_CASE("572.133 flexion: the moment counts while the rotation is inside, decay is to 10 N m") {
  // The interval begins when the sine reaches 77 deg; the moment falls by 1.5 N m/ms by then.
  const double from_s = 60 * kMs * 2 / std::numbers::pi * std::asin(77.0 / 84);
  const auto figures =
      judged_response(test_of("572.133 flexion"),
                      curves(sine(84 * kDeg, 60 * kMs), triangle(85, 40 * kMs, 10, 90 * kMs)));
  REQUIRE(figures.size() == 3);
  check(figures, "peak rotation", 84 * kDeg, 0);
  const double inside = 85 - 1500 * (from_s - 40 * kMs);
  const JudgedFigure& peak = figure(figures, "peak moment inside");
  REQUIRE(peak.value);
  CHECK(*peak.value == Approx(inside).margin(1e-3));  // 1500 N m/s times the time's error
  CHECK(peak.is_inside());                            // the largest of all, 85, would not be
  check(figures, "time of moment decay", 90 * kMs, 0);
}

TEST_CASE("572.133: a peak between samples within the corridor's time is that of a parabola") {
  const auto figures = judged_response(test_of("572.133 flexion"),
                                       curves(sine(84 * kDeg, 60 * kMs), sine(76, 55.03 * kMs)));
  check(figures, "peak moment inside", 76, 0);
  // The sine falls to 10: 76 sin(...) = 10 in its falling half.
  const double decay_s = 55.03 * kMs * (2 - 2 / std::numbers::pi * std::asin(10.0 / 76));
  check(figures, "time of moment decay", decay_s, (decay_s - 90 * kMs) / (10 * kMs));
}

TEST_CASE("572.133 extension: a rotation beyond its corridor leaves the times before and after") {
  // 120 deg at 80 ms; -80 N m there do not count, but the moment while 114 deg are passed.
  const double to_s = 80 * kMs * 2 / std::numbers::pi * std::asin(114.0 / 120);
  const auto figures =
      judged_response(test_of("572.133 extension"),
                      curves(sine(120 * kDeg, 80 * kMs), triangle(-80, 80 * kMs, 0, 112 * kMs)));
  check(figures, "peak rotation", 120 * kDeg, (120 - 106.5) / 7.5);
  CHECK(*figure(figures, "peak moment inside").value ==
        Approx(-80 * to_s / (80 * kMs)).margin(1e-3));
  check(figures, "time of moment decay", 108 * kMs, 4.0 / 10);
}

TEST_CASE("572.123: decay is to 5 N m, and curves count from their values at time zero") {
  const auto rotation = sine(83 * kDeg, 70 * kMs);
  const auto moment = triangle(30, 65 * kMs, 5, 113 * kMs);
  const auto figures = judged_response(test_of("572.123 flexion"),
                                       curves([&](double t) { return rotation(t) + 3 * kDeg; },
                                              [&](double t) { return moment(t) - 2; }));
  check(figures, "peak rotation", 83 * kDeg, 0);
  check(figures, "peak moment inside", 30, 0);
  check(figures, "time of moment decay", 113 * kMs, 0);

  const auto extension =
      judged_response(test_of("572.123 extension"),
                      curves(sine(94 * kDeg, 80 * kMs), triangle(-21.5, 80 * kMs, -5, 0.135)));
  check(extension, "peak rotation", 94 * kDeg, 0);
  check(extension, "peak moment inside", -21.5, 0);
  check(extension, "time of moment decay", 135 * kMs, 0);
}

TEST_CASE("572.33 does not say that channels are zero at time zero, so they count as they are") {
  const auto rotation = sine(71 * kDeg, 60.5 * kMs);
  const auto figures = judged_response(
      test_of("572.33 flexion"),
      curves([&](double t) { return rotation(t) + 3 * kDeg; }, sine(72.5 * lbf_ft(), 52.5 * kMs)));
  check(figures, "peak rotation", 74 * kDeg, 3.0 / 7);
}

TEST_CASE("limits belong to their corridor, and nothing beyond them") {
  const Limits limits{0.057, 0.064};
  for (const double edge : {limits.low, limits.high}) {
    const double out = edge == limits.low ? 0 : 1;
    CHECK(JudgedFigure{"", "s", limits, edge, ""}.is_inside());
    CHECK_FALSE(JudgedFigure{"", "s", limits, std::nextafter(edge, out), ""}.is_inside());
  }
  CHECK(*JudgedFigure{"", "s", limits, 0.064, ""}.half_corridors() == Approx(1));
  CHECK(*JudgedFigure{"", "s", limits, 0.057, ""}.half_corridors() == Approx(-1));
  CHECK_FALSE(JudgedFigure{"", "s", limits, {}, "why"}.is_inside());
  CHECK_FALSE(JudgedFigure{"", "s", {.high = 1}, 0.5, ""}.half_corridors());
}

TEST_CASE("figures that cannot be found say so and fail") {
  const auto problem = [](const char* test, const Curve& rotation, const Curve& moment,
                          const char* name, double end_s = 0.25) {
    const auto figures = judged_response(test_of(test), curves(rotation, moment, end_s));
    const JudgedFigure& found = figure(figures, name);
    CHECK_FALSE(found.value);
    CHECK_FALSE(found.is_inside());
    return found.problem;
  };
  const auto good_rotation = sine(71 * kDeg, 60.5 * kMs);
  const auto good_moment = sine(72.5 * lbf_ft(), 52.5 * kMs);
  const auto rising = [](double t) { return 10 * t; };
  // The record ends before the rotation reverses, or before it is back at zero.
  CHECK(problem("572.33 flexion", rising, good_moment, "peak rotation") ==
        "no peak within the record");
  CHECK(problem("572.33 flexion", rising, good_moment, "first zero crossing") ==
        "no peak within the record");
  CHECK(problem("572.33 flexion", good_rotation, good_moment, "first zero crossing", 0.1) ==
        "not within the record");
  // The rotation is to the other side only.
  CHECK(problem(
            "572.33 flexion", [](double t) { return -t; }, good_moment, "peak rotation") ==
        "never in the test's direction");
  CHECK(problem(
            "572.33 extension", good_rotation, [](double t) { return t; }, "peak moment") ==
        "never in the test's direction");
  // The moment does not decay.
  const auto staying = [](double t) {
    return 80 * std::min(t / 0.05, 1.0) - std::max(t - .05, 0.);
  };
  CHECK(problem("572.133 flexion", sine(84 * kDeg, 60 * kMs), staying, "time of moment decay") ==
        "not within the record");
  // The moment is never above the level, and the rotation does not reach it.
  CHECK(problem("572.133 flexion", good_rotation, sine(8, 50 * kMs), "time of moment decay") ==
        "never above that level");
  CHECK(problem("572.133 flexion", good_rotation, good_moment, "peak moment inside") ==
        "the rotation is never in its corridor");
}

TEST_CASE("curves that cannot be judged are refused") {
  const CertificationTest test = test_of("572.33 flexion");
  ResponseCurves bad = curves(sine(1, 0.06), sine(90, 0.05));
  bad.moment_Nm.conservativeResize(7);
  CHECK_THROWS_AS(judged_response(test, bad), std::invalid_argument);
  bad = curves(sine(1, 0.06), sine(90, 0.05));
  bad.time_s[3] = bad.time_s[2];
  CHECK_THROWS_AS(judged_response(test, bad), std::invalid_argument);
  bad = curves(sine(1, 0.06), sine(90, 0.05));
  bad.rotation_rad[3] = std::nan("");
  CHECK_THROWS_AS(judged_response(test, bad), std::invalid_argument);
}
