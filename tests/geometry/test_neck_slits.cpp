// SPDX-License-Identifier: GPL-3.0-or-later
#include <limits>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/neck/neck_slits.h"

namespace flexneck::geometry {
namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

const NeckDivisions kEven{.quadrant = 4, .inner_ring = 3, .rubber_layers = 4};

std::string refusal(const NeckSlits& slits, const NeckDivisions& divisions = kEven) {
  try {
    check(slits, divisions);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("a neck has no slits unless they are asked for") {
  const NeckSlits none;
  CHECK(refusal(none, {}) == "accepted");
  CHECK(script_constants(none).empty());
  CHECK(slit_face_sets(none).empty());
}

TEST_CASE("slit depths outside the ligament are refused with the inequality and the value") {
  for (const double depth : {0.0, 1.0, -0.2, 1.5, std::numeric_limits<double>::quiet_NaN()}) {
    for (const SlitState state : {SlitState::none, SlitState::closed, SlitState::open}) {
      CHECK_THAT(refusal({.state = state, .depth = depth}), Contains("0 < slit_depth < 1, found "));
    }
  }
  CHECK_THAT(refusal({.state = SlitState::open, .depth = 1.5}), Contains("found 1.5"));
  CHECK_THAT(refusal({.state = SlitState::open}), Contains("slits need slit_depth"));
  for (const double depth : {1e-6, 0.5, 1 - 1e-6}) {
    CHECK(refusal({.state = SlitState::open, .depth = depth}) == "accepted");
  }
}

TEST_CASE("slits need lines and planes of the mesh to lie on") {
  const NeckSlits open{.state = SlitState::open, .depth = 0.5};
  NeckDivisions divisions = kEven;
  divisions.rubber_layers = 3;
  CHECK_THAT(refusal(open, divisions), Contains("rubber_layers is even; found rubber_layers = 3"));
  CHECK(refusal({.state = SlitState::none, .depth = 0.5}, divisions) == "accepted");
  divisions.refine = 1;  // a layer's middle is no plane between layers of the script
  CHECK_THAT(refusal(open, divisions), Contains("rubber_layers is even"));
  divisions = kEven;
  divisions.quadrant = 5;
  CHECK_THAT(refusal(open, divisions), Contains("quadrant is even; found quadrant = 5"));
  divisions = kEven;
  divisions.inner_ring = 1;
  CHECK_THAT(refusal(open, divisions), Contains("inner_ring >= 2; found 1"));
}

TEST_CASE("slits lie in rubber sections, each once") {
  NeckSlits slits{.state = SlitState::open, .parts = {"rubber_5"}, .depth = 0.5};
  CHECK_THAT(refusal(slits), Contains("no rubber section 'rubber_5'"));
  slits.parts = {"plate_1"};
  CHECK_THAT(refusal(slits), Contains("no rubber section 'plate_1'"));
  slits.parts = {};
  CHECK_THAT(refusal(slits), Contains("expected at least one rubber section"));
  slits.parts = {"rubber_1", "rubber_1"};
  CHECK_THAT(refusal(slits), Contains("rubber_1"));
  slits.parts = {"rubber_4", "rubber_1"};
  CHECK(refusal(slits) == "accepted");
  CHECK(slit_face_sets(slits) == std::vector<std::string>{"slit_rubber_1", "slit_rubber_4"});
  const std::map<std::string, double> expected = {
      {"slit_depth", 0.5}, {"slit_rubber_1", 1}, {"slit_rubber_4", 1}};
  CHECK(script_constants(slits) == expected);
  slits.state = SlitState::none;
  CHECK(script_constants(slits) == std::map<std::string, double>{{"slit_depth", 0.5}});
}

}  // namespace flexneck::geometry
