// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "multibody/numerics/time_table.h"

using flexneck::InputError;
using flexneck::multibody::TimeTable;
using Outside = TimeTable::Outside;

namespace {

/// A few roundings of numbers of order one.
constexpr double kRounding = 1e-14;

const std::vector<double> kTimes = {0.5, 1.0, 3.0};
const std::vector<double> kValues = {2.0, 4.0, -1.0};

}  // namespace

TEST_CASE("An empty table is zero everywhere") {
  const TimeTable table;
  CHECK(table.value(1.5) == 0);
  CHECK(table.integral(1.5) == 0);
  CHECK(table.second_integral(1.5) == 0);
}

TEST_CASE("A table is linear between its rows and takes their values") {
  const TimeTable table(kTimes, kValues, Outside::zero);
  CHECK(table.value(0.5) == 2.0);
  CHECK(table.value(0.75) == Approx(3.0).epsilon(kRounding));
  CHECK(table.value(1.0) == 4.0);
  CHECK(table.value(2.0) == Approx(1.5).epsilon(kRounding));
  CHECK(table.value(3.0) == -1.0);
}

TEST_CASE("Outside its times a table is zero or keeps its end values") {
  const TimeTable zero(kTimes, kValues, Outside::zero);
  const TimeTable constant(kTimes, kValues, Outside::constant);
  const double just_before = std::nextafter(0.5, 0.0);
  const double just_after = std::nextafter(3.0, 4.0);
  CHECK(zero.value(just_before) == 0);
  CHECK(zero.value(just_after) == 0);
  CHECK(constant.value(just_before) == 2.0);
  CHECK(constant.value(just_after) == -1.0);
}

TEST_CASE("The integrals are those of the polynomials") {
  const auto outside = GENERATE(Outside::zero, Outside::constant);
  const TimeTable table(kTimes, kValues, outside);
  // On [0.5, 1]: f = 2 + 4 u; I = 2 u + 2 u^2; II = u^2 + 2/3 u^3 with u = t - 0.5.
  CHECK(table.integral(0.4) == 0);
  CHECK(table.second_integral(0.4) == 0);
  CHECK(table.integral(0.7) == Approx(0.48).epsilon(kRounding));
  CHECK(table.second_integral(0.7) == Approx(0.04 + 2.0 / 3 * 0.008).epsilon(kRounding));
  // On [1, 3]: f = 4 - 2.5 u; I = 1.5 + 4 u - 1.25 u^2; II = 1/3 + 1.5 u + 2 u^2 - 1.25/3 u^3.
  CHECK(table.integral(2.0) == Approx(4.25).epsilon(kRounding));
  CHECK(table.second_integral(2.0) == Approx(1.0 / 3 + 3.5 - 1.25 / 3).epsilon(kRounding));
  // Beyond 3: I(3) = 4.5, II(3) = 1/3 + 3 + 8 - 10/3 = 8; the constant adds -u and -u^2 / 2.
  const double tail = outside == Outside::constant ? -1 : 0;
  CHECK(table.integral(5.0) == Approx(4.5 + 2 * tail).epsilon(kRounding));
  CHECK(table.second_integral(5.0) == Approx(8 + 9 + 2 * tail).epsilon(kRounding));
}

TEST_CASE("A table of one row is a jump that lasts or an instant") {
  CHECK(TimeTable({1.0}, {3.0}, Outside::constant).value(9) == 3);
  CHECK(TimeTable({1.0}, {3.0}, Outside::constant).integral(3) == Approx(6).epsilon(kRounding));
  CHECK(TimeTable({1.0}, {3.0}, Outside::zero).value(1) == 3);
  CHECK(TimeTable({1.0}, {3.0}, Outside::zero).integral(3) == 0);
}

TEST_CASE("Times that do not increase, odd counts and numbers that are none are refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(TimeTable({0, 1, 1}, {0, 1, 2}, Outside::zero),
                    Catch::Contains("increase strictly") && Catch::Contains("row 3"));
  CHECK_THROWS_WITH(TimeTable({0, 1}, {0}, Outside::zero), Catch::Contains("2 times but 1 values"));
  CHECK_THROWS_AS(TimeTable({0, nan}, {0, 1}, Outside::zero), InputError);
  CHECK_THROWS_AS(TimeTable({0, 1}, {nan, 1}, Outside::zero), InputError);
}
