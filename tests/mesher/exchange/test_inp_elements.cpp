// SPDX-License-Identifier: GPL-3.0-or-later
#include <sstream>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "mesher/mesh/mesh_measures.h"
#include "mesher/mesh/positions.h"
#include "tests/mesher/exchange/files.h"

namespace flexneck::mesher {
namespace {

using Catch::Matchers::Contains;
using testing::Files;
using testing::import_options;
using testing::warning_of_deck;

/// An element as the Abaqus manual draws it (6.14, Elements, "Three-dimensional solid element
/// library"): corners in reference coordinates, then the two corners of each midside node, then the
/// corners of the sides S1, S2, …; all counted from 1.
struct ManualElement {
  std::string type;
  ElementKind kind;
  std::vector<std::array<double, 3>> corners;
  std::vector<std::pair<int, int>> midsides;
  std::vector<std::vector<int>> sides;
};

const std::vector<ManualElement>& manual() {
  static const std::vector<std::array<double, 3>> kCube = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1},
                                                           {-1, 1, -1},  {-1, -1, 1}, {1, -1, 1},
                                                           {1, 1, 1},    {-1, 1, 1}};
  static const std::vector<std::vector<int>> kCubeSides = {
      {1, 2, 3, 4}, {5, 8, 7, 6}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 8, 4}, {4, 8, 5, 1}};
  static const std::vector<ManualElement> kManual = {
      {"C3D8I", ElementKind::hex8, kCube, {}, kCubeSides},
      {"C3D20R",
       ElementKind::hex20,
       kCube,
       {{1, 2},
        {2, 3},
        {3, 4},
        {4, 1},
        {5, 6},
        {6, 7},
        {7, 8},
        {8, 5},
        {1, 5},
        {2, 6},
        {3, 7},
        {4, 8}},
       kCubeSides},
      {"c3d10",
       ElementKind::tet10,
       {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
       {{1, 2}, {2, 3}, {3, 1}, {1, 4}, {2, 4}, {3, 4}},
       {{1, 2, 3}, {1, 4, 2}, {2, 4, 3}, {3, 4, 1}}},
      {"C3D4",
       ElementKind::tet4,
       {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
       {},
       {{1, 2, 3}, {1, 4, 2}, {2, 4, 3}, {3, 4, 1}}},
      {"C3D6",
       ElementKind::prism6,
       {{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
       {},
       {{1, 2, 3}, {4, 6, 5}, {1, 4, 5, 2}, {2, 5, 6, 3}, {3, 6, 4, 1}}},
      {"C3D15",
       ElementKind::prism15,
       {{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
       {{1, 2}, {2, 3}, {3, 1}, {4, 5}, {5, 6}, {6, 4}, {1, 4}, {2, 5}, {3, 6}},
       {{1, 2, 3}, {4, 6, 5}, {1, 4, 5, 2}, {2, 5, 6, 3}, {3, 6, 4, 1}}}};
  return kManual;
}

/// A skew map, under which no two directions can be confused.
Eigen::Vector3d skewed(const std::array<double, 3>& x) {
  Eigen::Matrix3d map;
  map << 2, 0.3, 0.1, -0.2, 3, 0.4, 0.5, -0.6, 5;
  return map * Eigen::Vector3d(x.data()) + Eigen::Vector3d(7, 8, 9);
}

std::array<double, 3> middle(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
}

/// A file with this element only, nodes numbered 10, 20, …, and a surface for each side.
std::string inp_of(const ManualElement& element) {
  std::vector<std::array<double, 3>> nodes = element.corners;
  for (const auto& [a, b] : element.midsides) {
    nodes.push_back(middle(element.corners[static_cast<std::size_t>(a - 1)],
                           element.corners[static_cast<std::size_t>(b - 1)]));
  }
  std::ostringstream text;
  text.precision(17);
  text << "*NODE\n";
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const Eigen::Vector3d x = skewed(nodes[n]);
    text << 10 * (n + 1) << ", " << x[0] << ", " << x[1] << ", " << x[2] << "\n";
  }
  text << "*ELEMENT, TYPE=" << element.type << ", ELSET=only\n5";
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    text << (n == 11 ? ",\n" : ", ") << 10 * (n + 1);  // long elements go on in the next line
  }
  text << "\n";
  for (std::size_t s = 1; s <= element.sides.size(); ++s) {
    text << "*SURFACE, NAME=side" << s << ", TYPE=ELEMENT\nonly, S" << s << "\n";
  }
  return text.str();
}

}  // namespace

TEST_CASE("every node of an Abaqus element comes to its place in ours, and every side") {
  for (const ManualElement& element : manual()) {
    INFO(element.type);
    const Files files;
    const Mesh mesh =
        import_mesh(import_options(files.write("one.inp", inp_of(element)), {"only"}), {});
    REQUIRE(mesh.blocks.size() == 1);
    REQUIRE(mesh.blocks[0].kind == element.kind);
    const auto reference = reference_nodes(element.kind);
    for (std::size_t n = 0; n < reference.size(); ++n) {
      const auto& x = mesh.nodes[static_cast<std::size_t>(mesh.blocks[0].nodes[n])];
      CHECK((Eigen::Vector3d(x.data()) - skewed(reference[n])).norm() < 1e-13);
    }
    const Eigen::Vector3d inside = positions_of(mesh, mesh.blocks[0].nodes).rowwise().mean();
    for (std::size_t s = 1; s <= element.sides.size(); ++s) {
      INFO("S" << s);
      const FaceBlock& face = mesh.face_set("side" + std::to_string(s)).blocks.at(0);
      const auto corners = corners_per_element(face.kind);
      REQUIRE(corners == element.sides[s - 1].size());
      Eigen::Vector3d expected = Eigen::Vector3d::Zero();
      for (const int corner : element.sides[s - 1]) {
        expected += skewed(element.corners[static_cast<std::size_t>(corner - 1)]) /
                    static_cast<double>(corners);
      }
      const Eigen::Matrix3Xd x = positions_of(mesh, std::span(face.nodes).first(corners));
      CHECK((x.rowwise().mean() - expected).norm() < 1e-13);
      const Eigen::Vector3d normal = (x.col(1) - x.col(0)).cross(x.col(2) - x.col(1));
      CHECK(normal.dot(expected - inside) > 0);
    }
  }
}

TEST_CASE("a C3D20R is taken as it is where the modes are of reduced integration") {
  const std::string deck = inp_of(manual()[1]) +
                           "*Material, name=m\n*Elastic\n1., .3\n*Density\n1.\n"
                           "*Solid section, elset=only, material=m\n";
  CHECK_THAT(warning_of_deck(deck), Contains("1 integration rules of C3D20R"));
  CHECK(warning_of_deck(deck, true).empty());
}

}  // namespace flexneck::mesher
