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
  CHECK(parse_quantity("24.15 g", "m/s^2") == near(24.15 * gravity));
  CHECK(parse_quantity("24.15 g", "kg") == near(0.02415));
  CHECK(factor_from_si("g", "gn") == 1);
  CHECK(factor_from_si("g", "mg") == near(1000));
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
  CHECK_THROWS_WITH(parse_quantity("0.4 s", "m"), Contains("'s', which has another dimension"));
  CHECK_THROWS_WITH(parse_quantity("0.0981 lbf/in^3", "kg/m^3"), Contains("another dimension"));
  CHECK_THROWS_WITH(parse_quantity("4 g*s", "m/s"), Contains("another dimension"));
  CHECK_THROWS_AS(parse_quantity("1 Hz", "rad"), InputError);
  CHECK_THROWS_AS(parse_quantity("30 deg", "m/m"), InputError);
}

TEST_CASE("a number within a unit, a comma and what measures something else are no factors") {
  // UDUNITS-2 alone takes the first ten as 2 kg, 2 kg, 2 kg, 5 kg^2, 0.5 m, m, 0.2 m, s^-2, K, W.
  for (const auto& [text, si_unit] : std::vector<std::pair<const char*, const char*>>{
           {"1 kg 2", "kg"},    {"1 2 kg", "kg"},     {"1 kg.2", "kg"},        {"1 kg^2.5", "kg^2"},
           {"1 m/2", "m"},      {"1 m 1", "m"},       {"1.5.2 m", "m"},        {"1 m-s", "m*s"},
           {"20 K @ 273", "K"}, {"1 lg(re mW)", "W"}, {"9,81 m/s^2", "m/s^2"}, {"1 / 2 m", "m"},
           {"0x10 m", "m"},     {"1e3e kg", "kg"},    {"1_000 m", "m"},        {"inf m", "m"},
           {"nan m", "m"},      {"1e999 m", "m"},     {"1e308 km", "m"},       {"20 degC", "K"},
           {"1 m\n", "m"},      {"5 Hz", "rad/s"},    {"5 rad/s", "Hz"},       {"5 N*m", "N*m/rad"},
           {"5 rpm", "Hz"},     {"5 %", "1"}}) {
    INFO(text);
    CHECK_THROWS_AS(parse_quantity(text, si_unit), InputError);
  }
  CHECK_THROWS_AS(parse_quantity("1 " + std::string(100000, 'm'), "m"), InputError);
  // Units are accepted as tables and textbooks write them.
  const auto near = [](double value) { return Approx(value).epsilon(kRounding).margin(0); };
  CHECK(parse_quantity("3 kg m^2", "kg*m^2") == near(3));
  CHECK(parse_quantity("3 kg.m2", "kg*m^2") == near(3));
  CHECK(parse_quantity("3 kg m^2 s**-2", "J") == near(3));
  CHECK(parse_quantity("3 (m/s)^2", "m^2/s^2") == near(3));
  CHECK(parse_quantity("3 N/(m*s)", "N/(m*s)") == near(3));
  CHECK(parse_quantity("3 1/s", "Hz") == near(3));
  CHECK(parse_quantity("3 rpm", "rad/s") == near(3 * 2 * std::numbers::pi / 60));
  CHECK(parse_quantity("3 ft*lbf/deg", "N*m/rad") ==
        near(3 * 0.3048 * 0.45359237 * 9.80665 * 180 / std::numbers::pi));
}
