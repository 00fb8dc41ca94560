// SPDX-License-Identifier: GPL-3.0-or-later
#include <functional>
#include <limits>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "mesher/mesh/mesh.h"
#include "mesher/mesh/mesh_measures.h"
#include "mesher/mesh/mesh_summary.h"
#include "tests/mesher/small_mesh.h"

namespace flexneck::mesher {
namespace {

using Catch::Matchers::Contains;

constexpr double kRounding = 1e-14;

std::string refusal(const std::function<void(Mesh&)>& change) {
  Mesh mesh = testing::small_mesh();
  change(mesh);
  try {
    check(mesh);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("a sound mesh passes the check") { CHECK_NOTHROW(check(testing::small_mesh())); }

TEST_CASE("node indices out of range are refused") {
  CHECK_THAT(refusal([](Mesh& mesh) { mesh.blocks[1].nodes[5] = 45; }),
             Contains("part 'lower' refers to node 45") && Contains("45 nodes"));
  CHECK_THAT(refusal([](Mesh& mesh) { mesh.face_sets[0].blocks[0].nodes[0] = -1; }),
             Contains("face set 'floor' refers to node -1"));
  CHECK_THAT(refusal([](Mesh& mesh) { mesh.node_sets[0].nodes[8] = 99; }),
             Contains("node set 'floor' refers to node 99"));
}

TEST_CASE("loose nodes and nodes without position are refused") {
  CHECK_THAT(refusal([](Mesh& mesh) {
               mesh.nodes.push_back({9, 9, 9});
             }),
             Contains("1 nodes belong to no element") && Contains("node 45"));
  CHECK_THAT(
      refusal([](Mesh& mesh) { mesh.nodes[7][1] = std::numeric_limits<double>::quiet_NaN(); }),
      Contains("node 7 has no finite position"));
}

TEST_CASE("empty parts and sets are refused") {
  CHECK_THAT(refusal([](Mesh& mesh) { mesh.blocks.clear(); }),
             Contains("expected elements, found none"));
  CHECK_THAT(refusal([](Mesh& mesh) { mesh.blocks[0].nodes.clear(); }),
             Contains("part 'upper' is empty"));
  CHECK_THAT(refusal([](Mesh& mesh) { mesh.node_sets[0].nodes.clear(); }),
             Contains("node set 'floor' is empty"));
  CHECK_THAT(refusal([](Mesh& mesh) { mesh.face_sets[0].blocks[0].nodes.clear(); }),
             Contains("face set 'floor' is empty"));
}

TEST_CASE("names that are missing, doubled or no names of a file's objects are refused") {
  CHECK_THAT(refusal([](Mesh& mesh) { mesh.blocks[0].part = "lower"; }), Contains("'lower'"));
  CHECK_THAT(refusal([](Mesh& mesh) { mesh.materials[0].name = "hard"; }), Contains("'hard'"));
  CHECK_THAT(refusal([](Mesh& mesh) { mesh.node_sets[0].name = "a/b"; }), Contains("'a/b'"));
  CHECK_THAT(refusal([](Mesh& mesh) { mesh.face_sets.push_back(mesh.face_sets[0]); }),
             Contains("'floor'"));
  CHECK_THAT(refusal([](Mesh& mesh) { mesh.blocks[0].part = ""; }), Contains("no name"));
}

TEST_CASE("half elements, wrong dimensions and disorder are refused") {
  CHECK_THAT(refusal([](Mesh& mesh) { mesh.blocks[0].nodes.pop_back(); }),
             Contains("26 node indices, expected a multiple of 27"));
  CHECK_THAT(refusal([](Mesh& mesh) { mesh.face_sets[0].blocks[0].kind = ElementKind::hex27; }),
             Contains("kind hex27, expected dimension 2"));
  CHECK_THAT(refusal([](Mesh& mesh) {
               std::swap(mesh.node_sets[0].nodes[0], mesh.node_sets[0].nodes[1]);
             }),
             Contains("ascending"));
}

TEST_CASE("blocks of one part must differ in kind and agree in material") {
  const auto same_part = [](Mesh& mesh) { mesh.blocks[0].part = "lower"; };
  CHECK_THAT(refusal(same_part), Contains("part 'lower' has blocks of different materials"));
  CHECK_THAT(refusal([&](Mesh& mesh) {
               same_part(mesh);
               mesh.blocks[0].material = 1;
             }),
             Contains("part 'lower' has two blocks of kind hex27"));
}

TEST_CASE("pairs of a slit must lie on one another") {
  const auto slit = [](std::int32_t upper) {
    return [upper](Mesh& mesh) {
      mesh.nodes.push_back(mesh.nodes[44]);
      mesh.blocks[0].nodes[6] = 45;  // the corner at node 44
      mesh.slits = {{"cut", false, {44}, {upper}, {{0, 0, 1}}, {1}}};
      mesh.node_sets.push_back({"corner", {44}});
      mesh.blocks.push_back(mesh.blocks[0]);
      mesh.blocks.back().part = "twin";
      mesh.blocks.back().nodes[6] = 44;
    };
  };
  CHECK(refusal(slit(45)) == "accepted");
  CHECK_THAT(refusal(slit(43)), Contains("slit 'cut' pairs nodes 44 and 43"));
  CHECK_THAT(refusal(slit(44)), Contains("expected two coincident nodes"));
  CHECK_THAT(refusal(slit(46)), Contains("slit 'cut' refers to node 46"));
}

TEST_CASE("pairs of a slit have unit normals and finite areas") {
  const auto slit = [](double normal, double area_m2) {
    return [=](Mesh& mesh) {
      mesh.nodes.push_back(mesh.nodes[44]);
      mesh.blocks[0].nodes[6] = 45;
      mesh.slits = {{"cut", false, {44}, {45}, {{0, 0, normal}}, {area_m2}}};
      mesh.blocks.push_back(mesh.blocks[0]);
      mesh.blocks.back().part = "twin";
      mesh.blocks.back().nodes[6] = 44;
    };
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  CHECK(refusal(slit(-1, 0)) == "accepted");
  for (const double normal : {0.0, 0.999, 1e300, kNan})
    CHECK_THAT(refusal(slit(normal, 1)), Contains("slit 'cut': pair 0 must have a unit normal"));
  CHECK_THAT(refusal(slit(1, kNan)), Contains("a finite area"));
}

TEST_CASE("materials that no solid can have are refused") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const double modulus : {0.0, -1.0, kNan}) {
    CHECK_THAT(refusal([&](Mesh& mesh) { mesh.materials[0].youngs_modulus_Pa = modulus; }),
               Contains("material 'soft': Young's modulus must be > 0"));
  }
  for (const double ratio : {0.5, -1.0, kNan}) {
    CHECK_THAT(refusal([&](Mesh& mesh) { mesh.materials[1].poissons_ratio = ratio; }),
               Contains("material 'hard': Poisson's ratio must lie between -1 and 0.5"));
  }
  for (const double density : {0.0, kNan}) {
    CHECK_THAT(refusal([&](Mesh& mesh) { mesh.materials[1].density_kg_m3 = density; }),
               Contains("material 'hard': density must be > 0"));
  }
  CHECK_THAT(refusal([](Mesh& mesh) { mesh.blocks[0].material = 2; }),
             Contains("part 'upper' has no material"));
}

TEST_CASE("sets are found by name, a missing one is reported with those there are") {
  const Mesh mesh = testing::small_mesh();
  CHECK(mesh.node_set("floor").nodes.size() == 9);
  CHECK_THROWS_AS(mesh.face_set("flor"), InputError);
  CHECK_THROWS_WITH(mesh.face_set("flor"), Contains("face set 'flor'") && Contains("'floor'"));
}

TEST_CASE("the summary adds up volumes and masses") {
  const MeshSummary summary = summarise(testing::small_mesh());
  CHECK(summary.elements == 2);
  CHECK(summary.degrees_of_freedom == 135);
  CHECK(summary.parts[0].mass_kg == Approx(950).epsilon(kRounding));
  CHECK(summary.parts[1].mass_kg == Approx(2700).epsilon(kRounding));
  CHECK(summary.mass_kg == Approx(3650).epsilon(kRounding));
  CHECK(summary.smallest_scaled_jacobian == Approx(1).epsilon(kRounding));
}

TEST_CASE("the scaled Jacobian of a sheared box is the cosine of the shear") {
  Mesh mesh = testing::small_mesh();
  const double shear = std::tan(30 * M_PI / 180);
  for (auto& node : mesh.nodes) node[0] += shear * node[2];
  const BlockMeasure measured = measure(mesh, mesh.blocks[0]);
  CHECK(measured.volume_m3 == Approx(1).epsilon(kRounding));
  CHECK(measured.smallest_scaled_jacobian == Approx(std::cos(30 * M_PI / 180)).epsilon(kRounding));
}

TEST_CASE("ideal elements of every shape have the scaled Jacobian one, stretched ones less") {
  // Reference elements, sheared and scaled into a cube, an upright equilateral prism, a regular
  // tetrahedron and half a regular octahedron, all with edges of length one.
  const Eigen::Vector3d second(0.5, std::sqrt(3.0) / 2, 0);
  const Eigen::Vector3d apex(0.5, std::sqrt(3.0) / 6, std::sqrt(2.0 / 3));
  for (const ElementKind kind : element_kinds()) {
    if (dimension(kind) != 3) continue;
    Eigen::Matrix3d map = Eigen::Matrix3d::Identity() / 2;
    if (shape_of(kind) == ReferenceShape::prism) map.topLeftCorner<2, 2>() << 1, 0.5, 0, second[1];
    if (shape_of(kind) == ReferenceShape::tetrahedron) {
      map << Eigen::Vector3d::UnitX(), second, apex;
    }
    if (shape_of(kind) == ReferenceShape::pyramid) map(2, 2) = std::sqrt(0.5);
    for (const double stretch : {1.0, 3.0}) {
      Mesh mesh;
      mesh.blocks = {{.part = "one", .kind = kind, .material = 0, .nodes = {}}};
      for (const auto& reference : reference_nodes(kind)) {
        Eigen::Vector3d x = map * Eigen::Vector3d(reference.data());
        x[0] *= stretch;
        mesh.blocks[0].nodes.push_back(static_cast<std::int32_t>(mesh.nodes.size()));
        mesh.nodes.push_back({x[0], x[1], x[2]});
      }
      const BlockMeasure measured = measure(mesh, mesh.blocks[0]);
      if (stretch == 1) {
        CHECK(measured.smallest_scaled_jacobian == Approx(1).epsilon(kRounding));
        CHECK(measured.max_aspect_ratio == Approx(1).epsilon(kRounding));
      } else if (shape_of(kind) == ReferenceShape::hexahedron) {
        CHECK(measured.smallest_scaled_jacobian == Approx(1).epsilon(kRounding));
        CHECK(measured.max_aspect_ratio == Approx(3).epsilon(kRounding));
      } else {
        CHECK(measured.smallest_scaled_jacobian < 0.8);
        CHECK(measured.smallest_scaled_jacobian > 0.3);
      }
    }
  }
}

TEST_CASE("elements that are inverted, folded in a corner or flat are refused") {
  CHECK_NOTHROW(require_sound_elements(testing::small_mesh()));
  Mesh inverted = testing::small_mesh();
  for (auto& node : inverted.nodes) node[0] = -node[0];
  CHECK_THROWS_AS(require_sound_elements(inverted), ComputationError);

  // A corner moved along its edge, beyond the sixth of its length that a midside node allows: the
  // determinant is negative there and positive at every Gauss point.
  Mesh folded = testing::small_mesh();
  folded.nodes[44] = {0.65, 1, 2};
  CHECK_THROWS_WITH(require_sound_elements(folded),
                    Contains("part 'upper'") && Contains("inverted or degenerate"));

  Mesh flat = testing::small_mesh();
  for (auto& node : flat.nodes) node[2] = 0;
  CHECK_THROWS_AS(require_sound_elements(flat), ComputationError);
}

}  // namespace flexneck::mesher
