// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <utility>

#include <catch2/catch.hpp>

#include "multibody/forces/resistance.h"
#include "tests/support/finite_differences.h"

using Catch::Matchers::Contains;
using namespace flexneck::multibody;
using namespace flexneck::testing;

TEST_CASE("a load curve is its table or its cubic, and its energy the integral") {
  const LoadCurve table = LoadCurve::table({0, 0.1, 0.3}, {0, 5, 6});
  CHECK(table.value(0.05) == Approx(2.5));
  CHECK(table.value(0.2) == Approx(5.5));
  CHECK(table.value(0.5) == Approx(7));
  CHECK(table.energy(0.3) == Approx(0.25 + 1.1));
  CHECK(table.energy(0.5) == Approx(0.25 + 1.1 + 1.3));
  const LoadCurve cubic = LoadCurve::cubic(3, 4, 5);
  CHECK(cubic.value(0.2) == Approx(0.6 + 0.16 + 0.04));
  CHECK(cubic.energy(0.2) == Approx(3 * 0.04 / 2 + 4 * 0.008 / 3 + 5 * 0.0016 / 4));
  CHECK(LoadCurve().value(1) == 0);
  CHECK_THROWS_WITH(LoadCurve::table({0, 0.1, 0.1}, {0, 1, 2}), Contains("row 3"));
  CHECK_THROWS_WITH(LoadCurve::table({0.1, 0.2}, {0, 1}), Contains("first row"));
}

TEST_CASE("a curve that locks follows its law to nine tenths, then goes on straight") {
  const LoadCurve curve = LoadCurve::locking(10, 0.5);
  CHECK(curve.value(0.2) == Approx(10 * 0.2 / 0.6));
  CHECK(curve.value(0.45) == Approx(45));
  CHECK(curve.value(0.5) == Approx(45 + 1000 * 0.05));
  CHECK(curve.energy(0.2) == Approx(-2.5 * (0.4 + std::log(0.6))));
  for (const double x : {0.01, 0.3, 0.44, 0.46, 0.7}) {
    CAPTURE(x);
    CHECK(first_derivative([&](double t) { return curve.energy(x + t); }, 1e-4) ==
          Approx(curve.value(x)).epsilon(1e-9));
  }
  CHECK(curve.piece(0.44).number != curve.piece(0.46).number);
  CHECK(curve.continues(LoadCurve::locking(10, 0.5)));
  CHECK_FALSE(curve.continues(LoadCurve::locking(10, 0.6)));
  CHECK_THROWS_WITH(LoadCurve::locking(-1, 1), Contains("non-negative stiffness"));
  CHECK_THROWS_WITH(LoadCurve::locking(1, 0), Contains("positive deflection"));
}

TEST_CASE("a resistance loads and unloads each of its sides by that side's own law") {
  Resistance resistance;
  resistance.positive.curve = LoadCurve::cubic(100);
  resistance.positive.stop = 0.2;
  resistance.positive.beyond_stop = LoadCurve::cubic(400);
  resistance.positive.unloading_ratio = 0.5;
  resistance.negative.curve = LoadCurve::table({0, 0.1, 0.5}, {0, 5, 12});
  resistance.damping = 0.4;
  resistance.friction = 0.8;
  resistance.full_rate = 2;
  Resistance mirrored = resistance;
  std::swap(mirrored.positive, mirrored.negative);
  struct Expected {
    double x, v, load, stored_J, lost_W;
  };
  // Loading 30 + 40 N, at rest 3/4 of it; at half the full rate half of the dissipated part plus
  // 0.4 v.
  const double at_rest_N = 0.75 * 70;
  const double stored_J = 0.75 * (4.5 + 2);
  for (const Expected& at : {Expected{0.3, 1, at_rest_N + 8.75 + 0.4 + 0.4, stored_J, 9.55},
                             {0.3, -4, at_rest_N - 17.5 - 1.6 - 0.8, stored_J, 4 * 19.9},
                             {-0.3, 1, -8.5 + 0.4 + 0.4, 0.25 + 1.35, 0.8},
                             {-0.3, -4, -8.5 - 1.6 - 0.8, 0.25 + 1.35, 4 * 2.4}}) {
    CAPTURE(at.x, at.v);
    const ResistanceLoad found = evaluate(resistance, at.x, at.v);
    CHECK(found.load == Approx(at.load));
    CHECK(found.stored_J == Approx(at.stored_J));
    CHECK(found.lost_W == Approx(at.lost_W));
    const ResistanceLoad image = evaluate(mirrored, -at.x, -at.v);
    CHECK(image.load == Approx(-at.load));
    CHECK(image.stored_J == Approx(at.stored_J));
    CHECK(image.lost_W == Approx(at.lost_W));
  }
}

TEST_CASE("a law's pieces change where its load has a kink, and nowhere else") {
  Resistance resistance;
  resistance.positive.curve = LoadCurve::table({0, 0.1, 0.3}, {0, 5, 6});
  resistance.positive.stop = 0.2;
  resistance.positive.beyond_stop = LoadCurve::cubic(1, 2, 3);
  resistance.negative.curve = LoadCurve::cubic(30);
  resistance.friction = GENERATE(0.0, 2.0);
  resistance.full_rate = 0.5;
  const auto slope = [&](double x, double v, bool along_rate) {
    const auto load = [&](double step) {
      return evaluate(resistance, x + (along_rate ? 0 : step), v + (along_rate ? step : 0)).load;
    };
    return first_derivative(load, 1e-5);
  };
  const auto same = [&](double x, double v, double y, double w) {
    const LawPiece one = piece_of(resistance, x, v);
    const LawPiece other = piece_of(resistance, y, w);
    return one.deflection == other.deflection && one.rate == other.rate;
  };
  for (const double kink : {0.0, 0.1, 0.2}) {
    CAPTURE(kink);
    CHECK_FALSE(same(kink - 1e-3, 0.1, kink + 1e-3, 0.1));
    CHECK(std::abs(slope(kink - 1e-3, 0.1, false) - slope(kink + 1e-3, 0.1, false)) > 0.5);
  }
  for (const auto& [from, to] : {std::pair(-0.4, -0.01), {0.01, 0.09}, {0.11, 0.19}, {0.21, 0.29}})
    CHECK(same(from, 0.1, to, 0.1));
  CHECK(same(0.15, 0.49, 0.15, 0.51) == (resistance.friction == 0));
  CHECK(same(0.15, -0.49, 0.15, -0.51) == (resistance.friction == 0));
  CHECK(same(0.15, -0.4, 0.15, 0.4));
  // The same line on both sides has no kink at zero; a rope has one.
  resistance.positive = resistance.negative;
  CHECK(same(-1, 0.1, 1, 0.1));
  resistance.positive.curve = LoadCurve::table({0, 0.5, 1}, {0, 15, 16});
  resistance.negative.curve = LoadCurve::table({0, 0.2, 1}, {0, 6, 36});
  CHECK(same(-0.1, 0.1, 0.1, 0.1));
  resistance.negative.curve = LoadCurve::table({0, 0.2, 1}, {0, 7, 36});
  CHECK_FALSE(same(-0.1, 0.1, 0.1, 0.1));
  resistance.tension_only = true;
  CHECK_FALSE(same(-1, 0.1, 1, 0.1));
}
