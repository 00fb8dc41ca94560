// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>

#include <catch2/catch.hpp>

#include "geometry/neck/neck_slits.h"
#include "mesher/mesh/mesh_measures.h"
#include "mesher/mesh/mesh_summary.h"
#include "tests/support/neck_mesh.h"

namespace flexneck::mesher {
namespace {

using geometry::NeckDivisions;
using geometry::NeckParameters;
using geometry::NeckSlits;
using geometry::SlitState;
using testing::neck_parameters;

/// Relative error of a sector's area by a parabola through three points of an arc of 30 degrees,
/// 1.5e-4.
constexpr double kParabola = 1.6e-4;

Mesh slit_neck(const std::string& set, const NeckSlits& slits, const NeckDivisions& divisions,
               ElementKind element = ElementKind::hex27) {
  ScriptMeshOptions options = testing::neck_mesh_options(neck_parameters(set), divisions);
  options.constants.merge(geometry::script_constants(slits));
  options.element = element;
  if (element == ElementKind::tet10) options.constants["recombine"] = 0;
  options.slits = geometry::slit_face_sets(slits);
  options.slits_tied = slits.state == SlitState::closed;
  return mesh_script(options, {});
}

/// Area of a circle's part with x > 0.
double front_of_circle_m2(double radius, double centre_x) {
  return radius * radius * (M_PI - std::acos(centre_x / radius)) +
         centre_x * std::sqrt(radius * radius - centre_x * centre_x);
}

struct Circle {
  double radius, x;
};

/// The rubber's circle, and that of the slit's inner edge, at `depth` of the way to the hole.
std::pair<Circle, Circle> edges_of_slit(const NeckParameters& neck, const std::string& part,
                                        double depth) {
  for (const geometry::NeckLayer& layer : geometry::layers_of(neck)) {
    if (layer.part != part) continue;
    const Circle rim{layer.diameter_m / 2, layer.offset_m};
    return {rim, {depth * neck.hole_diameter / 2 + (1 - depth) * rim.radius, (1 - depth) * rim.x}};
  }
  throw std::invalid_argument(part);
}

double middle_of(const NeckParameters& neck, const std::string& part) {
  for (const geometry::NeckLayer& layer : geometry::layers_of(neck)) {
    if (layer.part == part) return layer.bottom_m + layer.thickness_m / 2;
  }
  throw std::invalid_argument(part);
}

}  // namespace

TEST_CASE("slits have the area of the front half between their circle and the rim") {
  const NeckDivisions divisions{.rubber_layers = 2};
  for (const double depth : {0.01, 0.35, 0.99}) {
    for (const ElementKind kind : {ElementKind::hex27, ElementKind::hex20, ElementKind::tet10}) {
      // Rings thinner than the sagitta of their arcs fold tetrahedra, but not hexahedra.
      if (kind != ElementKind::hex27 && depth != 0.35) continue;
      const std::string set = depth < 0.5 ? "A" : "C";
      INFO("set " << set << ", depth " << depth << ", " << name_of(kind));
      const NeckParameters neck = neck_parameters(set);
      const Mesh mesh = slit_neck(set, {.state = SlitState::open, .depth = depth}, divisions, kind);
      REQUIRE(mesh.slits.size() == 2);
      for (const Slit& slit : mesh.slits) {
        const std::string part = slit.name.substr(5);  // behind "slit_"
        const auto [rim, edge] = edges_of_slit(neck, part, depth);
        const double exact =
            front_of_circle_m2(rim.radius, rim.x) - front_of_circle_m2(edge.radius, edge.x);
        CHECK(area_m2(mesh, mesh.face_set(slit.name)) == Approx(exact).epsilon(kParabola));

        double innermost = neck.length;
        for (const std::int32_t node : mesh.node_set(slit.name).nodes) {
          const auto& x = mesh.nodes[static_cast<std::size_t>(node)];
          CHECK(x[2] == Approx(middle_of(neck, part)).epsilon(1e-9));
          CHECK(x[0] > -1e-9);
          if (std::abs(x[1]) < 1e-9) innermost = std::min(innermost, x[0]);
        }
        CHECK(innermost == Approx(edge.x + edge.radius).epsilon(1e-9));
        for (const auto& normal : slit.normals) CHECK(normal[2] == Approx(1));
      }
    }
  }
}

TEST_CASE("slits are doubled from the rim to their circle, between -90 and 90 degrees") {
  // Out of six rings, 0.5 leaves three outside: 2 * 3 nodes outwards, 4 * 4 - 1 around the front.
  const NeckDivisions divisions{
      .quadrant = 4, .inner_ring = 6, .rubber_layers = 2, .ring_grading = 1};
  const Mesh mesh = slit_neck("C", {.state = SlitState::open, .depth = 0.5}, divisions);
  for (const Slit& slit : mesh.slits) CHECK(slit.lower.size() == 6 * 15);
}

TEST_CASE("closed, open and no slits of one depth are the same mesh but for the doubled nodes") {
  const NeckDivisions divisions{.rubber_layers = 4};
  const auto mesh_with = [&](SlitState state) {
    return slit_neck("C", {.state = state, .parts = {"rubber_1", "rubber_4"}, .depth = 0.4},
                     divisions);
  };
  const Mesh none = mesh_with(SlitState::none);
  const Mesh closed = mesh_with(SlitState::closed);
  const Mesh open = mesh_with(SlitState::open);
  CHECK(none.slits.empty());
  CHECK(none.face_sets.size() == 2);
  REQUIRE(closed.slits.size() == 2);
  CHECK(closed.slits[0].name == "slit_rubber_1");
  CHECK(closed.slits[1].name == "slit_rubber_4");
  CHECK((closed.slits[0].tied && closed.slits[1].tied));
  CHECK((!open.slits[0].tied && !open.slits[1].tied));
  CHECK(open.nodes == closed.nodes);

  std::map<std::int32_t, std::int32_t> original;
  for (const Slit& slit : closed.slits) {
    for (std::size_t p = 0; p < slit.lower.size(); ++p) original[slit.upper[p]] = slit.lower[p];
  }
  REQUIRE(closed.nodes.size() == none.nodes.size() + original.size());
  CHECK(std::equal(none.nodes.begin(), none.nodes.end(), closed.nodes.begin()));
  for (std::size_t b = 0; b < none.blocks.size(); ++b) {
    CHECK(open.blocks[b].nodes == closed.blocks[b].nodes);
    std::vector<std::int32_t> shut = closed.blocks[b].nodes;
    for (std::int32_t& node : shut) {
      if (const auto found = original.find(node); found != original.end()) node = found->second;
    }
    CHECK(shut == none.blocks[b].nodes);
  }
  CHECK(summarise(open).volume_m3 == Approx(summarise(none).volume_m3).epsilon(1e-12));
}

}  // namespace flexneck::mesher
