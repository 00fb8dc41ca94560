// SPDX-License-Identifier: GPL-3.0-or-later
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/units.h"

using Catch::Matchers::Contains;
using flexneck::factor_from_si;
using flexneck::InputError;
using flexneck::parse_quantity;

namespace {
constexpr double kRounding = 1e-14;  // relative; conversions multiply a few exact factors
}

TEST_CASE("quantities come out in SI by the legal definitions of the units") {
  const double pound = 0.45359237;  // kg, exact by definition
  const double gravity = 9.80665;   // m/s^2, exact
  const double inch = 0.0254;       // m, exact
  const double pound_force = pound * gravity;
  const auto near = [](double value) { return Approx(value).epsilon(kRounding).margin(0); };

  CHECK(parse_quantity("0.4 in", "m") == near(0.4 * inch));
  CHECK(parse_quantity("-2.5in", "m") == near(-2.5 * inch));
  CHECK(parse_quantity("1.2 kpsi", "Pa") == near(1200 * pound_force / (inch * inch)));
  CHECK(parse_quantity("0.0981 lb/in^3", "kg/m^3") == near(0.0981 * pound / (inch * inch * inch)));
  CHECK(parse_quantity("0.1408 lbf*s^2*in", "kg*m^2") == near(0.1408 * pound_force * inch));
  CHECK(parse_quantity("400 lbf", "N") == near(400 * pound_force));
  CHECK(parse_quantity("24.15 gn", "m/s^2") == near(24.15 * gravity));
  CHECK(parse_quantity("120 deg", "rad") == near(120 * std::numbers::pi / 180));
  CHECK(parse_quantity("36.5 ms", "s") == near(0.0365));
  CHECK(parse_quantity("54.74 in/s", "m/s") == near(54.74 * inch));
  CHECK(factor_from_si("m", "in") == near(1 / inch));
  CHECK(factor_from_si("N*m", "lbf*ft") == near(1 / (pound_force * 12 * inch)));
}

TEST_CASE("a quantity without a usable unit is refused with the reason") {
  CHECK_THROWS_WITH(parse_quantity("0.4", "m"), Contains("expected a unit"));
  CHECK_THROWS_WITH(parse_quantity("in 0.4", "m"), Contains("expected a number"));
  CHECK_THROWS_WITH(parse_quantity("", "m"), Contains("expected a number"));
  CHECK_THROWS_WITH(parse_quantity("nan in", "m"), Contains("expected a number"));
  CHECK_THROWS_WITH(parse_quantity("0.4 inn", "m"), Contains("unknown unit 'inn'"));
  CHECK_THROWS_WITH(parse_quantity("0.4 s", "m"), Contains("'s', which measures something else"));
  CHECK_THROWS_WITH(parse_quantity("0.0981 lbf/in^3", "kg/m^3"), Contains("something else"));
  CHECK_THROWS_AS(parse_quantity("1 Hz", "rad"), InputError);
  CHECK_THROWS_AS(parse_quantity("30 deg", "m/m"), InputError);
}
