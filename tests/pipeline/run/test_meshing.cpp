// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes made for this process by the program flexneck-mesher.
#include <catch2/catch.hpp>

#include "mesher/mesh/bounding_box.h"
#include "pipeline/language/document/shipped_files.h"
#include "pipeline/run/make_mesh.h"
#include "pipeline/run/mesh_order.h"

using namespace flexneck;
using namespace flexneck::pipeline;

namespace {

constexpr double kPlace_m = 1e-11;  // accuracy of gmsh's node positions

Study cantilever(const std::string& constant) {
  return read_study(named_file("cantilever"), {"geometry.constants." + constant});
}

}  // namespace

TEST_CASE("studies are meshed in their order, and one whose script refuses leaves the others") {
  const Console console([](Message, const std::string&) {}, {});
  const Study shorter = cantilever("length=0.4 m");
  const Study refused = cantilever("lenght=0.4 m");
  const Study longer = cantilever("length=0.6 m");
  const auto outcomes = make_meshes({&shorter, &refused, &longer}, console);
  REQUIRE(outcomes.size() == 3);
  const auto length_m = [&](std::size_t k) {
    REQUIRE(outcomes[k].mesh.has_value());
    CHECK(outcomes[k].refusal.empty());
    return mesher::bounding_box(*outcomes[k].mesh).extent_m().x();
  };
  CHECK(length_m(0) == Approx(0.4).epsilon(0).margin(kPlace_m));
  CHECK_FALSE(outcomes[1].mesh.has_value());
  CHECK_THAT(outcomes[1].refusal, Catch::Matchers::Contains("lenght"));
  CHECK(length_m(2) == Approx(0.6).epsilon(0).margin(kPlace_m));
  CHECK_THROWS_WITH(make_mesh(refused, console), outcomes[1].refusal);
  CHECK(make_mesh(longer, console).nodes == outcomes[2].mesh->nodes);
}

TEST_CASE("an order of meshes comes back from its arguments, whatever its settings look like") {
  const MeshOrder order{"a folder", {{"one.toml", {}}, {"two.toml", {"modes.count=2", "2", ""}}}};
  const MeshOrder found = order_from(arguments_of(order));
  CHECK(found.folder == order.folder);
  REQUIRE(found.studies.size() == 2);
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(found.studies[k].study == order.studies[k].study);
    CHECK(found.studies[k].settings == order.studies[k].settings);
  }
  CHECK(mesh_result(order, 0) != mesh_result(order, 1));
}
