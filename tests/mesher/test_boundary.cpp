// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "mesher/mesh/boundary.h"
#include "mesher/mesh/positions.h"
#include "mesher/mesh/shape_functions.h"
#include "tests/mesher/small_mesh.h"

namespace flexneck::mesher {

TEST_CASE("the boundary has the facets of one element only, in order, with normals outwards") {
  const Mesh mesh = testing::small_mesh();
  const std::vector<Facet> facets = boundary_facets(mesh);
  REQUIRE(facets.size() == 10);  // six each, less the two that meet
  for (std::size_t k = 0; k < facets.size(); ++k) {
    CAPTURE(k);
    CHECK(facets[k].block == (k < 5 ? 0U : 1U));
    const Eigen::Matrix3Xd x = positions_of(mesh, facets[k].nodes);
    const ShapeTable table = tabulate(facets[k].kind, Eigen::Vector3d::Zero());
    const Eigen::Vector3d along_xi = x * table.derivatives[0];
    const Eigen::Vector3d along_eta = x * table.derivatives[1];
    const Eigen::Vector3d centre = x * table.values;
    const Eigen::Vector3d element(0.5, 0.5, facets[k].block == 0 ? 1.5 : 0.5);
    const Eigen::Vector3d normal = along_xi.cross(along_eta).normalized();
    CHECK((normal - 2 * (centre - element)).norm() < 1e-12);
  }
}

TEST_CASE("facets that meet are neighbours in the order of their keys, found at their elements") {
  const Mesh mesh = testing::small_mesh();
  const std::vector<FacetPlace> places = facets_by_key(mesh);
  REQUIRE(places.size() == 12);
  CHECK(std::is_sorted(places.begin(), places.end(),
                       [](const auto& a, const auto& b) { return a.key < b.key; }));
  int meeting = 0;
  for (std::size_t k = 1; k < places.size(); ++k) {
    if (places[k].key != places[k - 1].key) continue;
    ++meeting;
    CHECK(places[k].block != places[k - 1].block);
    CHECK(places[k].number == places[k].block);
    for (const FacetPlace& place : {places[k - 1], places[k]})
      for (const std::int32_t node : facet_at(mesh, place).nodes)
        CHECK(mesh.nodes[static_cast<std::size_t>(node)][2] == 1);  // between the two
  }
  CHECK(meeting == 1);
}

}  // namespace flexneck::mesher
