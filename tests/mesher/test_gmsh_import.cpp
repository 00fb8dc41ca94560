// SPDX-License-Identifier: GPL-3.0-or-later
#include <set>

#include <catch2/catch.hpp>
#include <gmsh.h>

#include "mesher/gmsh/gmsh_session.h"
#include "mesher/mesh/boundary.h"
#include "mesher/mesh/mesh_measures.h"
#include "tests/mesher/exchange/files.h"

namespace flexneck::mesher {
namespace {

using Catch::Matchers::Contains;
using testing::Files;
using testing::import_options;

constexpr double kRounding = 1e-12;

/// Writes two boxes of 2 x 1 x 1, one above the other with a common face, with tetrahedra of second
/// order, in every format that gmsh writes; lengths in `unit`s.
void write_boxes(const Files& files, const std::vector<std::string>& names, double unit = 1) {
  const GmshSession session;
  gmsh::model::occ::addBox(0, 0, 0, 2 * unit, unit, unit, 1);
  gmsh::model::occ::addBox(0, 0, unit, 2 * unit, unit, unit, 2);
  gmsh::vectorpair pieces;
  std::vector<gmsh::vectorpair> piece_of;
  gmsh::model::occ::fragment({{3, 1}, {3, 2}}, {}, pieces, piece_of);
  gmsh::model::occ::synchronize();
  gmsh::model::setPhysicalName(3, gmsh::model::addPhysicalGroup(3, {1}, 1), "lower");
  gmsh::model::setPhysicalName(3, gmsh::model::addPhysicalGroup(3, {2}, 2), "upper");
  gmsh::vectorpair floor;
  gmsh::model::getEntitiesInBoundingBox(-unit, -unit, -unit / 9, 3 * unit, 3 * unit, unit / 9,
                                        floor, 2);
  gmsh::model::setPhysicalName(2, gmsh::model::addPhysicalGroup(2, {floor[0].second}, 3), "floor");
  gmsh::option::setNumber("Mesh.MeshSizeMin", unit);
  gmsh::option::setNumber("Mesh.MeshSizeMax", unit);
  gmsh::option::setNumber("Mesh.ElementOrder", 2);
  gmsh::option::setNumber("Mesh.BdfFieldFormat", 1);
  gmsh::model::mesh::generate(3);
  for (const std::string& name : names) {
    const bool is_old = name.find('2') != std::string::npos;
    gmsh::option::setNumber("Mesh.MshFileVersion", is_old ? 2.2 : 4.1);
    gmsh::option::setNumber("Mesh.Binary", name.find("binary") != std::string::npos ? 1 : 0);
    gmsh::option::setNumber("Mesh.SaveParametric", name.find("parametric") != std::string::npos);
    gmsh::write(files / name);
  }
}

/// Writes two unit cubes side by side: one of hexahedra, the other left to gmsh, which puts
/// pyramids on the quadrilaterals between them and fills the rest with tetrahedra.
void write_hexahedra_beside_tetrahedra(const Files& files) {
  const GmshSession session;
  gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1, 1);
  gmsh::model::occ::addBox(1, 0, 0, 1, 1, 1, 2);
  gmsh::vectorpair pieces;
  std::vector<gmsh::vectorpair> piece_of;
  gmsh::model::occ::fragment({{3, 1}, {3, 2}}, {}, pieces, piece_of);
  gmsh::model::occ::synchronize();
  gmsh::vectorpair sides;
  gmsh::vectorpair edges;
  gmsh::model::getBoundary({{3, 1}}, sides, false, false);
  gmsh::model::getBoundary(sides, edges, false, false);
  for (const auto& edge : edges) gmsh::model::mesh::setTransfiniteCurve(edge.second, 4);
  for (const auto& side : sides) {
    gmsh::model::mesh::setTransfiniteSurface(side.second);
    gmsh::model::mesh::setRecombine(2, side.second);
  }
  gmsh::model::mesh::setTransfiniteVolume(1);
  gmsh::model::setPhysicalName(3, gmsh::model::addPhysicalGroup(3, {1, 2}, 1), "both");
  gmsh::option::setNumber("Mesh.MeshSizeMax", 0.4);
  gmsh::model::mesh::generate(3);
  gmsh::write(files / "linear.msh");
  gmsh::model::mesh::setOrder(2);
  gmsh::write(files / "quadratic.msh");
  gmsh::option::setNumber("Mesh.SecondOrderIncomplete", 1);
  gmsh::model::mesh::setOrder(1);
  gmsh::model::mesh::setOrder(2);
  gmsh::write(files / "serendipity.msh");
}

/// Checks volume and area, which are exact for a right order of nodes; a wrong one folds elements.
void check_boxes(const Mesh& mesh, const std::string& lower, const std::string& floor) {
  REQUIRE(mesh.blocks.size() == 2);
  CHECK(mesh.blocks[0].part == lower);
  CHECK(mesh.blocks[0].kind == ElementKind::tet10);
  CHECK(measure(mesh, mesh.blocks[0]).volume_m3 == Approx(2).epsilon(kRounding));
  CHECK(measure(mesh, mesh.blocks[1]).volume_m3 == Approx(2).epsilon(kRounding));
  CHECK(area_m2(mesh, mesh.face_set(floor)) == Approx(2).epsilon(kRounding));
  for (const std::int32_t node : mesh.node_set(floor).nodes) {
    CHECK(std::abs(mesh.nodes[static_cast<std::size_t>(node)][2]) < 1e-12);
  }
}

}  // namespace

TEST_CASE("a mesh comes over from every version of .msh, and from .unv, with its groups") {
  const Files files;
  const std::vector<std::string> names = {"text4.msh",
                                          "text2.msh",
                                          "binary4.msh",
                                          "binary2.msh",
                                          "parametric4.msh",
                                          "parametric2.msh",
                                          "binary_parametric4.msh",
                                          "binary_parametric2.msh",
                                          "mesh.unv"};
  write_boxes(files, names);
  for (const std::string& name : names) {
    INFO(name);
    check_boxes(import_mesh(import_options(files / name, {"lower", "upper"}), {}), "lower",
                "floor");
  }
}

TEST_CASE("a .bdf has no names: parts and sets are called by their properties") {
  const Files files;
  write_boxes(files, {"mesh.bdf"});
  const Mesh mesh = import_mesh(import_options(files / "mesh.bdf", {"volume_1", "volume_2"}), {});
  REQUIRE(mesh.face_sets.size() == 1);
  check_boxes(mesh, "volume_1", mesh.face_sets[0].name);
  CHECK_THAT(mesh.face_sets[0].name, Contains("surface_"));
}

TEST_CASE("a shape is meshed with tetrahedra of the size asked for, its volumes glued") {
  const Files files;
  write_boxes(files, {"shape.brep", "shape.step"});
  SECTION("BREP in centimetres") {
    ImportOptions options = import_options(files / "shape.brep", {"volume_1", "volume_2"});
    options.length_unit_m = 0.01;
    options.element_size_m = 0.005;
    options.box_sets = {{"roof", {-1, -1, 0.0199}, {1, 1, 0.0201}}};
    const Mesh mesh = import_mesh(options, {});
    REQUIRE(mesh.blocks.size() == 2);
    CHECK(measure(mesh, mesh.blocks[0]).volume_m3 == Approx(2e-6).epsilon(1e-9));
    CHECK(area_m2(mesh, mesh.face_set("roof")) == Approx(2e-4).epsilon(1e-9));
    // 4 x 2 x 2 cells of half the edge hold some five tetrahedra each.
    CHECK(mesh.blocks[0].size() > 40);
    CHECK(mesh.blocks[0].size() < 400);
    // The same file twice gives the same mesh.
    CHECK(import_mesh(options, {}).nodes == mesh.nodes);
  }
  SECTION("STEP knows its unit: gmsh writes millimetres") {
    ImportOptions options = import_options(files / "shape.step", {"volume_1", "volume_2"});
    options.element_size_m = 1e-3;
    const Mesh mesh = import_mesh(options, {});
    REQUIRE(mesh.blocks.size() == 2);
    CHECK(measure(mesh, mesh.blocks[0]).volume_m3 == Approx(2e-9).epsilon(1e-9));
  }
}

TEST_CASE("a length unit scales positions, and parts need materials that exist") {
  const Files files;
  write_boxes(files, {"mm.msh"}, 1000);
  ImportOptions options = import_options(files / "mm.msh", {"lower", "upper"});
  options.length_unit_m = 1e-3;
  check_boxes(import_mesh(options, {}), "lower", "floor");

  CHECK_THAT(testing::refusal(import_options(files / "mm.msh", {"lower"})),
             Contains("mm.msh") && Contains("part 'upper' has no material"));
  CHECK_THAT(testing::refusal(import_options(files / "mm.msh", {"lower", "upper", "uper"})),
             Contains("there is no part 'uper'") && Contains("did you mean 'upper'"));
  options.box_sets = {{"nowhere", {5, 5, 5}, {6, 6, 6}}};
  CHECK_THAT(testing::refusal(options), Contains("set 'nowhere': no face of the surface"));
}

TEST_CASE("pyramids between hexahedra and tetrahedra close the mesh") {
  const Files files;
  write_hexahedra_beside_tetrahedra(files);
  const auto kinds_of = [&](const std::string& name) {
    const Mesh mesh = import_mesh(import_options(files / name, {"both"}), {});
    CHECK_NOTHROW(require_sound_elements(mesh));
    double volume = 0;
    std::set<ElementKind> kinds;
    for (const ElementBlock& block : mesh.blocks) {
      kinds.insert(block.kind);
      volume += measure(mesh, block).volume_m3;
    }
    const FaceSet all =
        faces_among(boundary_facets(mesh), "all", [](std::int32_t) { return true; });
    CHECK(volume == Approx(2).epsilon(kRounding));
    CHECK(area_m2(mesh, all) == Approx(10).epsilon(kRounding));
    return kinds;
  };
  using enum ElementKind;
  CHECK(kinds_of("linear.msh") == std::set{hex8, tet4, pyramid5});
  CHECK(kinds_of("quadratic.msh") == std::set{hex27, tet10, pyramid14});
  CHECK(kinds_of("serendipity.msh") == std::set{hex20, tet10, pyramid13});
}

TEST_CASE("elements that a mesh cannot hold are refused with their number and type") {
  const Files files;
  const std::string mesh = testing::kTetrahedronMsh;
  const std::string nodes = " 1 2 3 4 5 6 7 8 9 10 1 2 3 4 5 6 7 8 9 10\n";
  const std::string cubics = "1 29 2 7 1" + nodes + "2 29 2 7 1" + nodes;
  const std::size_t begin = mesh.find("1\n1 11 2");
  const auto file =
      files.write("cubics.msh", mesh.substr(0, begin) + "2\n" + cubics + "$EndElements\n");
  CHECK_THAT(testing::refusal(import_options(file, {"corner"})),
             Contains("physical volume 'corner'") && Contains("2 of type 'Tetrahedron 20'"));
}

TEST_CASE("a .msh without nodes or without elements is refused before gmsh reads it") {
  const Files files;
  const std::string mesh = testing::kTetrahedronMsh;
  for (const std::string section : {"Nodes", "Elements"}) {
    std::string without = mesh;
    const std::size_t begin = without.find("$" + section);
    const std::string end = "$End" + section + "\n";
    without.erase(begin, without.find(end) + end.size() - begin);
    CHECK_THAT(testing::refusal(import_options(files.write("part.msh", without), {"corner"})),
               Contains("part.msh") && Contains("expected $Nodes and $Elements"));
  }
}

TEST_CASE("physical surfaces of one name are one set, whatever their numbers") {
  const Files files;
  std::string mesh = testing::kTetrahedronMsh;
  const std::size_t begin = mesh.find("1\n1 11 2");
  mesh = mesh.substr(0, begin) +
         "3\n1 11 2 7 1 1 2 3 4 5 6 7 8 9 10\n2 9 2 8 1 1 3 2 7 6 5\n3 9 2 9 2 1 2 4 5 10 8\n"
         "$EndElements\n";
  mesh.replace(mesh.find("1\n3 7"), 2, "3\n2 8 \"walls\"\n2 9 \"walls\"\n");
  const Mesh read = import_mesh(import_options(files.write("walls.msh", mesh), {"corner"}), {});
  REQUIRE(read.face_sets.size() == 1);
  CHECK(area_m2(read, read.face_set("walls")) == Approx(1));
  CHECK(read.node_set("walls").nodes == std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7, 9});
}

TEST_CASE("groups that share an entity of MSH 2.2 have the same elements of it, or are refused") {
  const Files files;
  std::string mesh = testing::kTetrahedronMsh;
  mesh.replace(mesh.find("1\n3 7"), 2, "3\n2 8 \"bottom\"\n2 9 \"side\"\n");
  const auto with_surfaces = [&](const std::string& elements) {
    return mesh.substr(0, mesh.find("1\n1 11 2")) + "3\n1 11 2 7 1 1 2 3 4 5 6 7 8 9 10\n" +
           elements + "$EndElements\n";
  };
  const std::string bottom = " 1 3 2 7 6 5\n";
  const Mesh both = import_mesh(
      import_options(
          files.write("same.msh", with_surfaces("2 9 2 8 1" + bottom + "3 9 2 9 1" + bottom)),
          {"corner"}),
      {});
  CHECK(both.node_set("bottom").nodes == both.node_set("side").nodes);
  CHECK_THAT(testing::refusal(import_options(
                 files.write("mixed.msh",
                             with_surfaces("2 9 2 8 1" + bottom + "3 9 2 9 1 1 2 4 5 10 8\n")),
                 {"corner"})),
             Contains("groups 8 and 9") && Contains("elementary entity 1"));
  CHECK_THAT(testing::refusal(import_options(
                 files.write("none.msh", with_surfaces("2 9 2 8 1\n3 9 2 8 1\n")), {"corner"})),
             Contains("none.msh"));
}

TEST_CASE("points and curves in groups become node sets") {
  const Files files;
  std::string mesh = testing::kTetrahedronMsh;
  const std::size_t begin = mesh.find("1\n1 11 2");
  mesh = mesh.substr(0, begin) +
         "3\n1 11 2 7 1 1 2 3 4 5 6 7 8 9 10\n2 8 2 8 1 1 2 5\n3 15 2 9 1 4\n$EndElements\n";
  mesh.replace(mesh.find("1\n3 7"), 2, "3\n1 8 \"edge\"\n0 9 \"apex\"\n");
  const Mesh read = import_mesh(import_options(files.write("sets.msh", mesh), {"corner"}), {});
  CHECK(read.node_set("edge").nodes == std::vector<std::int32_t>{0, 1, 4});
  CHECK(read.node_set("apex").nodes == std::vector<std::int32_t>{3});
}

}  // namespace flexneck::mesher
