// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <functional>
#include <limits>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/neck/neck_parameters.h"
#include "tests/support/neck_parameters.h"

namespace flexneck::geometry {
namespace {

using Catch::Matchers::Contains;
using testing::kInch;
using testing::neck_parameters;

/// Text of the refusal of parameter set C after a change.
std::string refusal(const std::function<void(NeckParameters&)>& change) {
  NeckParameters neck = neck_parameters("C");
  change(neck);
  try {
    check(neck);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

constexpr std::array kFields = {
    &NeckParameters::length,
    &NeckParameters::base_plate_thickness,
    &NeckParameters::plate_thickness,
    &NeckParameters::top_plate_thickness,
    &NeckParameters::plate_diameter,
    &NeckParameters::hole_diameter,
    &NeckParameters::centre_rubber_diameter,
    &NeckParameters::centre_rubber_offset,
    &NeckParameters::bottom_rubber_diameter,
    &NeckParameters::bottom_rubber_offset,
    &NeckParameters::top_rubber_diameter,
    &NeckParameters::top_rubber_offset,
    &NeckParameters::bolt_circle_radius,
    &NeckParameters::bolt_patch_radius,
};

}  // namespace

TEST_CASE("the four fitted necks are possible") {
  for (const char* set : {"A", "B", "C", "C'"}) {
    INFO(set);
    CHECK_NOTHROW(check(neck_parameters(set)));
  }
}

TEST_CASE("plates and four rubber heights add up to the neck's length") {
  for (const char* set : {"A", "B", "C", "C'"}) {
    const NeckParameters neck = neck_parameters(set);
    const double sum = neck.base_plate_thickness + 3 * neck.plate_thickness +
                       neck.top_plate_thickness + 4 * rubber_height(neck);
    CHECK(sum == Approx(5.66 * kInch).epsilon(1e-14));
  }
}

TEST_CASE("every dimension that is negative, infinite or not a number is refused") {
  for (const auto field : kFields) {
    for (const double bad : {-1e-3, std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()}) {
      CHECK_THAT(refusal([&](NeckParameters& neck) { neck.*field = bad; }),
                 Contains("neck geometry: ") && Contains(" must be ") && Contains("found"));
    }
  }
}

TEST_CASE("only offsets may be zero") {
  const auto may_be_zero = [](double NeckParameters::*field) {
    return field == &NeckParameters::centre_rubber_offset ||
           field == &NeckParameters::bottom_rubber_offset ||
           field == &NeckParameters::top_rubber_offset;
  };
  for (const auto field : kFields) {
    const std::string result = refusal([&](NeckParameters& neck) { neck.*field = 0; });
    CHECK((result == "accepted") == may_be_zero(field));
  }
}

TEST_CASE("plates that leave no height for the rubber are refused with both sides in inches") {
  // 1.357 + 3 * 1.333 + 0.306 = 5.662
  CHECK_THAT(refusal([](NeckParameters& neck) { neck.plate_thickness = 1.333 * kInch; }),
             Contains("no height remains for the rubber") && Contains("5.662 in") &&
                 Contains("must be less than length = 5.66 in"));
}

TEST_CASE("the hole stays inside every rubber circle, offset included") {
  // The hole's edge 0.3125 in, shifted, against half of each diameter.
  CHECK_THAT(refusal([](NeckParameters& neck) { neck.centre_rubber_diameter = 1.0 * kInch; }),
             Contains("hole_diameter / 2 + centre_rubber_offset = 0.5125 in") &&
                 Contains("must be less than centre_rubber_diameter / 2 = 0.5 in"));
  CHECK_THAT(refusal([](NeckParameters& neck) { neck.bottom_rubber_diameter = 1.3 * kInch; }),
             Contains("hole_diameter / 2 + bottom_rubber_offset = 0.6635 in"));
  CHECK_THAT(refusal([](NeckParameters& neck) { neck.top_rubber_diameter = 1.4 * kInch; }),
             Contains("hole_diameter / 2 + top_rubber_offset = 0.7125 in"));
}

TEST_CASE("shifted rubber circles stay inside the plates") {
  CHECK_THAT(refusal([](NeckParameters& neck) { neck.centre_rubber_offset = 0.36 * kInch; }),
             Contains("centre_rubber_diameter / 2 + centre_rubber_offset = 1.71 in") &&
                 Contains("must be less than plate_diameter / 2 = 1.7 in"));
  CHECK_THAT(refusal([](NeckParameters& neck) { neck.bottom_rubber_offset = 0.69 * kInch; }),
             Contains("bottom_rubber_offset = 1.709 in"));
  CHECK_THAT(refusal([](NeckParameters& neck) { neck.top_rubber_offset = 0.58 * kInch; }),
             Contains("top_rubber_offset = 1.713 in"));
}

TEST_CASE("bolt patches stay on the base plate and clear of the hole") {
  CHECK_THAT(refusal([](NeckParameters& neck) { neck.bolt_circle_radius = 1.6 * kInch; }),
             Contains("bolt_circle_radius + bolt_patch_radius = 1.73 in"));
  CHECK_THAT(refusal([](NeckParameters& neck) { neck.bolt_circle_radius = 0.4 * kInch; }),
             Contains("bolt_circle_radius - bolt_patch_radius = 0.27 in"));
}

TEST_CASE("bolts stand on their circle in the four diagonal directions") {
  const auto centres = bolt_centres(neck_parameters("A"));
  for (std::size_t b = 0; b < centres.size(); ++b) {
    const double angle = std::atan2(centres[b][1], centres[b][0]) * 180 / M_PI;
    CHECK(std::hypot(centres[b][0], centres[b][1]) == Approx(1.25 * kInch).epsilon(1e-14));
    CHECK(std::fmod(angle + 360, 360) == Approx(45 + 90 * static_cast<double>(b)).epsilon(1e-14));
    CHECK(centres[b][2] == 0);
  }
}

TEST_CASE("divisions below one and gradings that are not positive are refused by name") {
  CHECK_NOTHROW(check(NeckDivisions{}));
  CHECK_THROWS_WITH(check(NeckDivisions{.inner_ring = 0}),
                    Contains("inner_ring must be 1 or more, found 0"));
  CHECK_THROWS_WITH(check(NeckDivisions{.end_plate_layers = -2}),
                    Contains("end_plate_layers must be 1 or more, found -2"));
  CHECK_THROWS_WITH(check(NeckDivisions{.refine = -1}), Contains("refine must be 0 or more"));
  CHECK_THROWS_WITH(check(NeckDivisions{.rubber_grading = 0}),
                    Contains("rubber_grading must be > 0"));
  CHECK_THROWS_WITH(check(NeckDivisions{.ring_grading = std::numeric_limits<double>::quiet_NaN()}),
                    Contains("ring_grading must be > 0"));
}

TEST_CASE("presets are known by name, and refinement multiplies their hexahedra") {
  CHECK(hexahedra(divisions_preset("default")) == 896);
  NeckDivisions paper = divisions_preset("paper");
  CHECK(hexahedra(paper) == 2400);  // the paper: 2386
  paper.refine = 2;
  CHECK(hexahedra(paper) == 2400 * 27);
  CHECK_THROWS_WITH(divisions_preset("papr"), Contains("did you mean 'paper'?"));
}

TEST_CASE("the script is told of refinement only where there is any") {
  const NeckParameters neck = neck_parameters("C");
  CHECK(script_constants(neck, {}).count("refine") == 0);
  CHECK(script_constants(neck, {.refine = 2}).at("refine") == 3);
  CHECK(script_constants(neck, {}).at("plate_diameter") == neck.plate_diameter);
  CHECK(script_constants(neck, {}).count("bolt_circle_radius") == 0);
}

}  // namespace flexneck::geometry
