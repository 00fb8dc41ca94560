// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "mesher/gmsh/gmsh_session.h"
#include "mesher/gmsh/script_mesher.h"
#include "mesher/mesh/mesh_measures.h"
#include "mesher/mesh/positions.h"
#include "mesher/mesh/shape_functions.h"
#include "tests/mesher/scripts.h"

namespace flexneck::mesher {
namespace {

using Catch::Matchers::Contains;
using testing::kBrick;
using testing::ScriptFixture;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

/// Volume by the divergence theorem: the flux of x / 3 through a closed surface, if normals point
/// out.
double enclosed_volume(const Mesh& mesh, const FaceBlock& faces) {
  const Quadrature rule = gauss_rule(faces.kind, 4);
  const ShapeTable table = tabulate(faces.kind, rule.points);
  const std::size_t n = nodes_per_element(faces.kind);
  double flux = 0;
  for (std::size_t first = 0; first < faces.nodes.size(); first += n) {
    const Eigen::Matrix3Xd x = positions_of(mesh, std::span(faces.nodes).subspan(first, n));
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Vector3d along_xi = x * table.derivatives[0].col(q);
      const Eigen::Vector3d along_eta = x * table.derivatives[1].col(q);
      const Eigen::Vector3d position = x * table.values.col(q);
      flux += rule.weights[q] * position.dot(along_xi.cross(along_eta)) / 3;
    }
  }
  return flux;
}

constexpr double kRounding = 1e-13;

}  // namespace

TEST_CASE("a script's block becomes second-order hexahedra without loose nodes") {
  const Mesh mesh = ScriptFixture(kBrick).mesh();
  REQUIRE(mesh.blocks.size() == 1);
  CHECK(mesh.blocks[0].part == "brick");
  CHECK(mesh.blocks[0].kind == ElementKind::hex27);
  CHECK(mesh.blocks[0].size() == 8);
  CHECK(mesh.nodes.size() == 125);  // 2 x 2 x 2 elements, 5 nodes in each direction
  CHECK(measure(mesh, mesh.blocks[0]).volume_m3 == Approx(1 * 2 * 3).epsilon(kRounding));
  CHECK(measure(mesh, mesh.blocks[0]).smallest_scaled_jacobian == Approx(1).epsilon(kRounding));
}

TEST_CASE(
    "a script's lengths are in the unit given, and a scaling that gmsh keeps to files is refused") {
  const Mesh metres = ScriptFixture(kBrick).mesh();
  ScriptFixture inches(kBrick);
  inches.options.length_unit_m = 0.0254;
  const Mesh mesh = inches.mesh();
  REQUIRE(mesh.nodes.size() == metres.nodes.size());
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    for (std::size_t d = 0; d < 3; ++d) CHECK(mesh.nodes[n][d] == 0.0254 * metres.nodes[n][d]);
  }
  for (const std::string option : {"Mesh.ScalingFactor", "Geometry.ScalingFactor"}) {
    CHECK_THROWS_WITH(ScriptFixture(kBrick + (option + " = 0.001;\n")).mesh(),
                      Contains(option + " = 0.001 has no effect") && Contains("geometry.unit"));
    CHECK_NOTHROW(ScriptFixture(kBrick + (option + " = 1;\n")).mesh());
  }
}

TEST_CASE("constants override the script's values by the last part of their name") {
  ScriptFixture script(kBrick);
  script.options.constants = {{"width", 2.5}, {"cells", 3}};
  const Mesh mesh = script.mesh();
  CHECK(mesh.blocks[0].size() == 12);
  CHECK(measure(mesh, mesh.blocks[0]).volume_m3 == Approx(2.5 * 2 * 3).epsilon(kRounding));
  // No state of one run affects the next.
  CHECK(ScriptFixture(kBrick).mesh().blocks[0].size() == 8);
}

TEST_CASE("faces point outwards, on plane and on curved surfaces") {
  const Mesh brick = ScriptFixture(kBrick).mesh();
  CHECK(enclosed_volume(brick, brick.face_set("skin").blocks.at(0)) ==
        Approx(6).epsilon(kRounding));

  // A quarter turn of the square [1, 2] x [0, 1] about the z axis.
  const Mesh bend = ScriptFixture(R"(
Point(1) = {1, 0, 0}; Point(2) = {2, 0, 0};
Line(1) = {1, 2};
Transfinite Curve {1} = 2;
f[] = Extrude {0, 0, 1} { Line{1}; Layers{1}; Recombine; };
v[] = Extrude { {0, 0, 1}, {0, 0, 0}, Pi / 2 } { Surface{f[1]}; Layers{4}; Recombine; };
Physical Volume("brick") = {v[1]};
Physical Surface("skin") = {f[1], v[0], v[2], v[3], v[4], v[5]};
)")
                        .mesh();
  const double volume = measure(bend, bend.blocks[0]).volume_m3;
  CHECK(enclosed_volume(bend, bend.face_set("skin").blocks.at(0)) ==
        Approx(volume).epsilon(kRounding));
  CHECK(volume == Approx(M_PI / 4 * (4 - 1)).epsilon(2e-4));  // four parabolas for a quarter circle
}

TEST_CASE("a face set brings the node set of its nodes") {
  const Mesh mesh = ScriptFixture(kBrick).mesh();
  CHECK(mesh.node_set("skin").nodes.size() == 125 - 27);  // all but the 3 x 3 x 3 inside
}

TEST_CASE("node patches take the nodes near their centres and say where there are none") {
  ScriptFixture script(kBrick);
  NodePatches patches{
      .name = "corners", .face_set = "skin", .centres_m = {{0, 0, 0}, {1, 2, 3}}, .radius_m = 0.26};
  script.options.patches = {patches};
  // Spacing 0.25, 0.5, 0.75: the corner itself and its neighbour along x.
  CHECK(script.mesh().node_set("corners").nodes.size() == 4);

  patches.centres_m.push_back({1.5, 2, 3});
  script.options.patches = {patches};
  CHECK_THROWS_AS(script.mesh(), InputError);
  CHECK_THROWS_WITH(script.mesh(), Contains("node set 'corners'") &&
                                       Contains("within 0.26 m of (1.5, 2, 3) m") &&
                                       Contains("the nearest is 0.5 m away") &&
                                       Contains("increase the radius or refine the mesh"));
  script.options.patches = {{.name = "x", .face_set = "skim", .centres_m = {}, .radius_m = 1}};
  CHECK_THROWS_WITH(script.mesh(), Contains("no node set 'skim'") && Contains("'skin'"));
}

TEST_CASE("a script that is missing or has an error is refused with gmsh's words") {
  ScriptFixture missing(kBrick);
  missing.options.script.replace_filename("nowhere.geo");
  CHECK_THROWS_WITH(missing.mesh(), Contains("nowhere.geo") && Contains("cannot be read"));

  const ScriptFixture broken(std::string(kBrick) + "\nPoint(7) = {0, 0;\n");
  CHECK_THROWS_AS(broken.mesh(), InputError);
  CHECK_THROWS_WITH(broken.mesh(), Contains("test.geo") && Contains("line 12: syntax error"));

  const ScriptFixture unknown(std::string(kBrick) + "\nLine(99) = {1, 77};\n");
  CHECK_THROWS_WITH(unknown.mesh(), Contains("test.geo") && Contains("77"));
}

TEST_CASE("a constant that the script does not declare is refused with the nearest that it does") {
  ScriptFixture script(kBrick);
  script.options.constants = {{"widht", 2}};
  CHECK_THROWS_AS(script.mesh(), InputError);
  CHECK_THROWS_WITH(script.mesh(), Contains("test.geo") && Contains("declared constant 'widht'") &&
                                       Contains("did you mean 'width'") &&
                                       !Contains("Number of physical groups"));  // gmsh's own
  script.options.constants = {{"bare", 2}};  // has no Name: gmsh keeps it to itself
  CHECK_THROWS_WITH(script.mesh(), Contains("declared constant 'bare'") &&
                                       Contains("DefineConstant[bare = {1, Name"));
}

TEST_CASE("every part needs a material and every material's part must exist") {
  ScriptFixture script(kBrick);
  script.options.material_of_part = {};
  CHECK_THROWS_AS(script.mesh(), InputError);
  CHECK_THROWS_WITH(script.mesh(), Contains("part 'brick' has no material"));
  script.options.material_of_part = {{"brick", "stuf"}};
  CHECK_THROWS_WITH(script.mesh(), Contains("part 'brick'") && Contains("did you mean 'stuff'"));
  script.options.material_of_part = {{"brick", "stuff"}, {"brik", "stuff"}};
  CHECK_THROWS_WITH(script.mesh(), Contains("no part 'brik'"));
}

TEST_CASE("the kind asked for is what the mesh is made of") {
  for (const auto& [kind, faces, nodes] : {std::tuple(ElementKind::hex27, ElementKind::quad9, 125U),
                                           {ElementKind::hex20, ElementKind::quad8, 81U},
                                           {ElementKind::hex8, ElementKind::quad4, 27U}}) {
    INFO(name_of(kind));
    ScriptFixture script(kBrick);
    script.options.element = kind;
    const Mesh mesh = script.mesh();
    CHECK(mesh.blocks[0].kind == kind);
    CHECK(mesh.nodes.size() == nodes);
    CHECK(mesh.face_set("skin").blocks.at(0).kind == faces);
    CHECK(measure(mesh, mesh.blocks[0]).volume_m3 == Approx(6).epsilon(kRounding));
  }
}

TEST_CASE("a script decides whether there are hexahedra") {
  ScriptFixture script(R"(
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Mesh.MeshSizeMin = 1;
Physical Volume("brick") = {1};
)");
  CHECK(script.mesh().blocks[0].kind == ElementKind::tet10);  // no wish: what there is
  script.options.element = ElementKind::tet10;
  const Mesh mesh = script.mesh();
  CHECK(mesh.blocks[0].kind == ElementKind::tet10);
  CHECK(measure(mesh, mesh.blocks[0]).volume_m3 == Approx(1).epsilon(kRounding));
  // If tetrahedra are asked for, the script's recombination is ignored.
  ScriptFixture recombined(R"(
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Mesh.MeshSizeMin = 1;
Mesh.RecombineAll = 1;
Physical Volume("brick") = {1};
)");
  recombined.options.element = ElementKind::tet10;
  const Mesh tetrahedra = recombined.mesh();
  REQUIRE(tetrahedra.blocks.size() == 1);
  CHECK(tetrahedra.blocks[0].kind == ElementKind::tet10);
  script.options.element = ElementKind::hex20;
  CHECK_THROWS_AS(script.mesh(), InputError);
  CHECK_THROWS_WITH(script.mesh(),
                    Contains("the script makes elements of kind tet10, but mesh.element is hex20"));
  script.options.element = ElementKind::prism18;
  CHECK_THROWS_WITH(script.mesh(),
                    Contains("hex27, hex20, hex8 or tet10 for a script, found prism18"));
}

TEST_CASE("tetrahedra of first order that were not asked for are refused") {
  ScriptFixture tetrahedra(R"(
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Mesh.MeshSizeMin = 1;
Physical Volume("brick") = {1};
)");
  tetrahedra.options.element = ElementKind::hex8;  // first order
  CHECK_THROWS_AS(tetrahedra.mesh(), InputError);
  CHECK_THROWS_WITH(tetrahedra.mesh(),
                    Contains("the script makes elements of kind tet4, but mesh.element is hex8"));
}

TEST_CASE("volumes outside every part, unnamed parts and scripts without parts are refused") {
  const std::string brick(kBrick);
  CHECK_THROWS_WITH(
      ScriptFixture(replaced(brick, "Physical Volume(\"brick\") = {v[1]};", "")).mesh(),
      Contains("no physical volume"));
  CHECK_THROWS_WITH(ScriptFixture(replaced(brick, "\"brick\"", "5")).mesh(),
                    Contains("without a name") && Contains("tag 5"));
  CHECK_THROWS_WITH(ScriptFixture(brick + "Physical Volume(\"twin\") = {v[1]};").mesh(),
                    Contains("belongs to 2 physical volumes"));
  CHECK_THROWS_WITH(
      ScriptFixture(brick + "Extrude {0, 0, 1} { Surface{v[0]}; Layers{1}; Recombine; }").mesh(),
      Contains("belongs to 0 physical volumes"));
}

TEST_CASE("a face set that bounds no part is refused") {
  CHECK_THROWS_WITH(ScriptFixture(std::string(kBrick) + R"(
Point(50) = {9, 0, 0}; Point(51) = {10, 0, 0};
Line(50) = {50, 51};
Transfinite Curve {50} = 2;
g[] = Extrude {0, 1, 0} { Line{50}; Layers{1}; Recombine; };
Physical Surface("adrift") = {g[1]};
)")
                        .mesh(),
                    Contains("'adrift' is on the boundary of no part"));
}

TEST_CASE("gmsh is used by one session at a time and free again afterwards") {
  {
    const GmshSession session;
    CHECK_THROWS_AS(GmshSession(), ComputationError);
  }
  CHECK_NOTHROW(GmshSession());
}

}  // namespace flexneck::mesher
