// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <set>

#include <catch2/catch.hpp>

#include "mesher/mesh/mesh_measures.h"
#include "mesher/mesh/mesh_summary.h"
#include "mesher/mesh/refinement.h"
#include "tests/support/block_mesh.h"
#include "tests/support/element_meshes.h"

namespace flexneck::mesher {
namespace {

constexpr double kFieldRounding = 1e-12;

Mesh box(std::array<int, 3> divisions, bool distorted = false) {
  testing::BlockMesh block = testing::box(divisions, {1, 1, 1}, {"steel", 2.1e11, 0.3, 7850});
  if (distorted) block.position = testing::distorted;
  return block.make();
}

/// Positions rounded to 1e-9.
std::set<std::array<long, 3>> places(const Mesh& mesh) {
  std::set<std::array<long, 3>> result;
  for (const auto& x : mesh.nodes) {
    result.insert({std::lround(1e9 * x[0]), std::lround(1e9 * x[1]), std::lround(1e9 * x[2])});
  }
  return result;
}

/// Returns whether each node of each element depends only on nodes of the element's parent.
bool hang_on_parents(const Mesh& mesh, const RefinedMesh& fine) {
  std::vector<std::set<std::int32_t>> parents;
  for (const ElementBlock& block : mesh.blocks) {
    const auto width = static_cast<std::ptrdiff_t>(nodes_per_element(block.kind));
    for (auto first = block.nodes.begin(); first != block.nodes.end(); first += width) {
      parents.emplace_back(first, first + width);
    }
  }
  std::size_t element = 0;
  for (const ElementBlock& block : fine.mesh.blocks) {
    const std::size_t width = nodes_per_element(block.kind);
    for (std::size_t k = 0; k < block.nodes.size(); ++k) {
      const auto& parent =
          parents.at(static_cast<std::size_t>(fine.parents.at(element + k / width)));
      for (decltype(fine.prolongation)::InnerIterator entry(fine.prolongation, block.nodes[k]);
           entry; ++entry) {
        if (parent.count(static_cast<std::int32_t>(entry.col())) == 0) return false;
      }
    }
    element += block.size();
  }
  return element == fine.parents.size();
}

}  // namespace

TEST_CASE(
    "a refined mesh of every kind fills the same curved volume with eight times the elements, one "
    "of "
    "pyramids with ten times") {
  for (const ElementKind kind : element_kinds()) {
    if (dimension(kind) != 3) continue;
    CAPTURE(name_of(kind));
    const Mesh mesh = testing::with_kind(box({2, 2, 1}, order_of(kind) > 1), kind);
    const RefinedMesh fine = refine(mesh);
    CHECK_NOTHROW(check(fine.mesh));
    CHECK_NOTHROW(require_sound_elements(fine.mesh));
    const MeshSummary before = summarise(mesh);
    const MeshSummary after = summarise(fine.mesh);
    const bool is_pyramid = shape_of(kind) == ReferenceShape::pyramid;
    CHECK(after.elements == (is_pyramid ? 10 : 8) * before.elements);
    // The rule is exact for the volume of tetrahedra and hexahedra; the prism's triangle rule is of
    // degree 5, that of its Jacobian 6.
    CHECK(after.volume_m3 == Approx(before.volume_m3).epsilon(1e-6));
    for (std::size_t k = 0; k < mesh.face_sets.size(); ++k) {
      CHECK(area_m2(fine.mesh, fine.mesh.face_sets[k]) ==
            Approx(area_m2(mesh, mesh.face_sets[k])).epsilon(1e-3));
      CHECK(fine.mesh.node_sets[k].nodes == nodes_of(fine.mesh.face_sets[k]).nodes);
    }
    CHECK(std::equal(mesh.nodes.begin(), mesh.nodes.end(), fine.mesh.nodes.begin()));
    CHECK(hang_on_parents(mesh, fine));
  }
}

TEST_CASE("raised elements have the nodes of cut ones, and fill the same volume") {
  for (const ElementKind kind : element_kinds()) {
    if (dimension(kind) != 3) continue;
    CAPTURE(name_of(kind));
    const Mesh mesh = testing::with_kind(box({2, 2, 2}), kind);
    const RefinedMesh raised = raise_order(mesh);
    CHECK_NOTHROW(check(raised.mesh));
    CHECK_NOTHROW(require_sound_elements(raised.mesh));
    CHECK(std::equal(mesh.nodes.begin(), mesh.nodes.end(), raised.mesh.nodes.begin()));
    CHECK(hang_on_parents(mesh, raised));
    CHECK(summarise(raised.mesh).elements == summarise(mesh).elements);
    CHECK(summarise(raised.mesh).volume_m3 == Approx(summarise(mesh).volume_m3).epsilon(1e-9));
    if (order_of(kind) == 1) {
      CHECK(places(raised.mesh) == places(refine(mesh).mesh));
      CHECK(raised.mesh.node_sets[0].nodes == nodes_of(raised.mesh.face_sets[0]).nodes);
    } else {
      CHECK(raised.mesh.blocks[0].kind == kind);
      CHECK(raised.mesh.nodes.size() == mesh.nodes.size());
    }
  }
}

TEST_CASE("neighbours share the new nodes: a refined box has those of a box of half the size") {
  for (const ElementKind kind : {ElementKind::hex8, ElementKind::hex20, ElementKind::hex27,
                                 ElementKind::prism6, ElementKind::prism15, ElementKind::prism18}) {
    CAPTURE(name_of(kind));
    const Mesh fine = refine(testing::with_kind(box({2, 1, 2}), kind)).mesh;
    const Mesh expected = testing::with_kind(box({4, 2, 4}), kind);
    CHECK(fine.nodes.size() == expected.nodes.size());
    if (shape_of(kind) == ReferenceShape::hexahedron) CHECK(places(fine) == places(expected));
  }
  // Tetrahedra: the octahedra inside are divided differently, but no position has two nodes. The
  // same holds for pyramids, whose second refinement meets the tetrahedra of the first.
  for (const ElementKind kind : {ElementKind::tet10, ElementKind::pyramid5, ElementKind::pyramid13,
                                 ElementKind::pyramid14}) {
    const Mesh fine = refine(refine(testing::with_kind(box({2, 1, 2}), kind)).mesh).mesh;
    CHECK(places(fine).size() == fine.nodes.size());
  }
}

TEST_CASE("the prolongation carries a quadratic field over exactly") {
  const auto field = [](const std::array<double, 3>& x) {
    return 1 + x[0] - 2 * x[1] + 3 * x[0] * x[2] - x[1] * x[1] + 0.5 * x[2] * x[2];
  };
  for (const ElementKind kind : element_kinds()) {
    if (dimension(kind) != 3 || order_of(kind) != 2) continue;
    CAPTURE(name_of(kind));
    const Mesh mesh = testing::with_kind(box({1, 2, 1}), kind);
    const RefinedMesh fine = refine(mesh);
    Eigen::VectorXd coarse(fine.prolongation.cols());
    for (Eigen::Index k = 0; k < coarse.size(); ++k) {
      coarse[k] = field(mesh.nodes[static_cast<std::size_t>(k)]);
    }
    const Eigen::VectorXd found = fine.prolongation * coarse;
    for (Eigen::Index k = 0; k < found.size(); ++k) {
      CHECK(std::abs(found[k] - field(fine.mesh.nodes[static_cast<std::size_t>(k)])) <
            kFieldRounding);
    }
  }
}

TEST_CASE("a set of single nodes stays as it is, and a slit keeps its pairs") {
  Mesh mesh = testing::with_slit(box({2, 2, 2}), 0.5, true,
                                 [](const Eigen::Vector3d& x) { return x[2] == 0.5 && x[0] < 0; });
  mesh.node_sets.push_back({"points", {0, 4}});
  const RefinedMesh fine = refine(mesh);
  CHECK(fine.mesh.node_set("points").nodes == std::vector<std::int32_t>{0, 4});
  const Slit& before = mesh.slits.front();
  const Slit& after = fine.mesh.slits.front();
  CHECK(after.tied);
  // A front of n rows of q nodes, without the tip, becomes one of 2n rows of 2q - 1.
  CHECK(after.lower.size() > 3 * before.lower.size());
  REQUIRE(after.upper.size() == after.lower.size());
  for (std::size_t p = 0; p < after.lower.size(); ++p) {
    CHECK(after.lower[p] != after.upper[p]);
    CHECK(fine.mesh.nodes[static_cast<std::size_t>(after.lower[p])] ==
          fine.mesh.nodes[static_cast<std::size_t>(after.upper[p])]);
  }
  // Every position with two nodes is one of the pairs.
  CHECK(places(fine.mesh).size() + after.lower.size() == fine.mesh.nodes.size());
}

}  // namespace flexneck::mesher
