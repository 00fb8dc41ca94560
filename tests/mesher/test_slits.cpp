// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "mesher/mesh/facet_key.h"
#include "mesher/mesh/mesh_measures.h"
#include "mesher/slits/slits.h"
#include "tests/mesher/scripts.h"

namespace flexneck::mesher {
namespace {

using Catch::Matchers::Contains;
using testing::ScriptFixture;

/// A block [0, 2] x [0, 1] x [-1, 1] with an internal face set "cut": z = 0, x < depth. Its mouth
/// lies on x = 0, y = 0 and y = 1, its tip on x = depth. Shape 0: hexahedra, 1: prisms, 2:
/// tetrahedra.
constexpr const char* kCrackedBlock = R"(
DefineConstant[ depth = {0.8, Name "depth"}, shape = {0, Name "shape"},
                along = {3, Name "along"}, beyond = {2, Name "beyond"}, across = {2, Name "across"} ];
Point(1) = {0, 0, -1};
a[] = Extrude {depth, 0, 0} { Point{1}; Layers{along}; };
b[] = Extrude {2 - depth, 0, 0} { Point{a[0]}; Layers{beyond}; };
If (shape == 0)
  f[] = Extrude {0, 1, 0} { Line{a[1], b[1]}; Layers{across}; Recombine; };
Else
  f[] = Extrude {0, 1, 0} { Line{a[1], b[1]}; Layers{across}; };
EndIf
If (shape == 2)
  v[] = Extrude {0, 0, 1} { Surface{f[1], f[5]}; Layers{2}; };
  w[] = Extrude {0, 0, 1} { Surface{v[0], v[6]}; Layers{2}; };
Else
  v[] = Extrude {0, 0, 1} { Surface{f[1], f[5]}; Layers{2}; Recombine; };
  w[] = Extrude {0, 0, 1} { Surface{v[0], v[6]}; Layers{2}; Recombine; };
EndIf
Physical Volume("above") = {w[1], w[7]};
Physical Volume("below") = {v[1], v[7]};
Physical Surface("cut") = {v[0]};
Physical Surface("whole_plane") = {v[0], v[6]};
Physical Surface("rest_of_plane") = {v[6]};
Physical Surface("outside") = {f[1], f[5], w[0], w[6], v[2], v[4], v[5], v[8], v[9], v[10],
                               w[2], w[4], w[5], w[8], w[9], w[10]};
Physical Surface("inner_wall") = {w[3]};
)";

struct Shape {
  std::string name;
  int constant;
  std::optional<ElementKind> element;
  /// Number of doubled nodes of a cut of m x k quadrilaterals or twice as many triangles.
  std::size_t (*doubled)(std::size_t m, std::size_t k);
  double tip_share;  ///< share of a face next to the tip, int N dA of its nodes there
};

std::size_t all_nodes(std::size_t m, std::size_t k) { return 2 * m * (2 * k + 1); }
std::size_t without_centres(std::size_t m, std::size_t k) { return all_nodes(m, k) - m * k; }
std::size_t corners(std::size_t m, std::size_t k) { return m * (k + 1); }

/// By Simpson's rule the tip's share of a quadratic face is a sixth, whatever its kind.
const std::vector<Shape> kShapes = {
    {"hex27", 0, ElementKind::hex27, all_nodes, 1.0 / 6},
    {"hex20", 0, ElementKind::hex20, without_centres, 1.0 / 6},
    {"hex8", 0, ElementKind::hex8, corners, 1.0 / 2},
    {"prism18", 1, std::nullopt, all_nodes, 1.0 / 6},
    {"tet10", 2, ElementKind::tet10, all_nodes, 1.0 / 6},
};

class Block : public ScriptFixture {
 public:
  explicit Block(const Shape& shape) : ScriptFixture(kCrackedBlock) {
    options.material_of_part = {{"above", "stuff"}, {"below", "stuff"}};
    options.element = shape.element;
    options.constants["shape"] = shape.constant;
  }
};

Mesh opened(const Mesh& mesh, const std::vector<std::string>& sets = {"cut"}) {
  Mesh result = mesh;
  open_slits(result, sets, false);
  check(result);
  return result;
}

std::vector<std::int32_t> all_elements(const Mesh& mesh) {
  std::vector<std::int32_t> nodes;
  for (const ElementBlock& block : mesh.blocks) {
    nodes.insert(nodes.end(), block.nodes.begin(), block.nodes.end());
  }
  return nodes;
}

/// Calls what(nodes of the element, block) for each element.
template <class What>
void for_each_element(const Mesh& mesh, const What& what) {
  for (const ElementBlock& block : mesh.blocks) {
    const std::size_t n = nodes_per_element(block.kind);
    for (std::size_t e = 0; e < block.size(); ++e) {
      what(std::span(block.nodes).subspan(e * n, n), block);
    }
  }
}

std::map<FacetKey, int> owners_of_sides(const Mesh& mesh) {
  std::map<FacetKey, int> owners;
  for_each_element(mesh, [&](std::span<const std::int32_t> nodes, const ElementBlock& block) {
    for (const ReferenceFacet& side : facets_of(block.kind)) ++owners[key_of_facet(side, nodes)];
  });
  return owners;
}

std::ptrdiff_t shared_sides(const Mesh& mesh) {
  const auto owners = owners_of_sides(mesh);
  return std::count_if(owners.begin(), owners.end(), [](const auto& o) { return o.second == 2; });
}

/// Number of bodies that are connected by common nodes.
std::size_t bodies(const Mesh& mesh) {
  std::vector<std::size_t> label(mesh.nodes.size());
  std::iota(label.begin(), label.end(), std::size_t{0});
  for (bool changed = true; changed;) {
    changed = false;
    for_each_element(mesh, [&](std::span<const std::int32_t> nodes, const ElementBlock&) {
      std::size_t least = label[static_cast<std::size_t>(nodes[0])];
      for (const auto n : nodes) least = std::min(least, label[static_cast<std::size_t>(n)]);
      for (const auto n : nodes) {
        changed = changed || label[static_cast<std::size_t>(n)] != least;
        label[static_cast<std::size_t>(n)] = least;
      }
    });
  }
  return std::set(label.begin(), label.end()).size();
}

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

constexpr double kRounding = 1e-12;
constexpr double kGrid = 1e-10;  ///< positions are rounded to 1.5e-11 of the largest, 2 m

}  // namespace

TEST_CASE("a crack doubles the nodes of its faces but those of its tip, in every kind of element") {
  for (const Shape& shape : kShapes) {
    INFO(shape.name);
    const Mesh whole = Block(shape).mesh();
    const Mesh mesh = opened(whole);
    REQUIRE(mesh.slits.size() == 1);
    const Slit& slit = mesh.slits[0];
    CHECK(slit.name == "cut");
    CHECK(slit.lower.size() == shape.doubled(3, 2));
    CHECK(mesh.nodes.size() == whole.nodes.size() + slit.lower.size());

    // Pairs are ordered: the copies are the last nodes, their originals ascend.
    CHECK(std::is_sorted(slit.lower.begin(), slit.lower.end()));
    for (std::size_t p = 0; p < slit.upper.size(); ++p) {
      CHECK(static_cast<std::size_t>(slit.upper[p]) == whole.nodes.size() + p);
    }
    // The mouth is open on three sides, the tip shut.
    std::set<double> x, y;
    for (const std::int32_t node : slit.lower) {
      x.insert(mesh.nodes[static_cast<std::size_t>(node)][0]);
      y.insert(mesh.nodes[static_cast<std::size_t>(node)][1]);
    }
    CHECK(*x.begin() == 0);
    CHECK(*x.rbegin() < 0.8 - 0.1);
    CHECK(*y.begin() == 0);
    CHECK(*y.rbegin() == Approx(1));
  }
}

TEST_CASE("a crack parts the elements below from those above, and nothing else") {
  for (const Shape& shape : kShapes) {
    INFO(shape.name);
    const Mesh whole = Block(shape).mesh();
    const Mesh mesh = opened(whole);
    const Slit& slit = mesh.slits[0];

    std::size_t faces = 0;
    for (const FaceBlock& block : whole.face_set("cut").blocks) faces += block.size();
    CHECK(shared_sides(whole) - shared_sides(mesh) == static_cast<std::ptrdiff_t>(faces));
    CHECK(bodies(mesh) == 1);

    // Closing the pairs gives back the mesh before.
    std::map<std::int32_t, std::int32_t> original;
    for (std::size_t p = 0; p < slit.lower.size(); ++p) original[slit.upper[p]] = slit.lower[p];
    std::vector<std::int32_t> closed = all_elements(mesh);
    for (std::int32_t& node : closed) {
      if (const auto found = original.find(node); found != original.end()) node = found->second;
    }
    CHECK(closed == all_elements(whole));

    // Lower nodes belong to elements with z < 0 only, upper ones to those with z > 0, though
    // "above" comes first in the mesh: the lower side is that of the first element.
    const std::set<std::int32_t> lower(slit.lower.begin(), slit.lower.end());
    const std::set<std::int32_t> upper(slit.upper.begin(), slit.upper.end());
    for_each_element(mesh, [&](std::span<const std::int32_t> nodes, const ElementBlock& block) {
      for (const std::int32_t node : nodes) {
        if (block.part == "above") CHECK(upper.count(node) == 0);
        if (block.part == "below") CHECK(lower.count(node) == 0);
      }
    });
    for (const auto& normal : slit.normals) {
      CHECK(normal == std::array<double, 3>{0, 0, -1});  // from the lower side to the upper
    }
  }
}

TEST_CASE("areas of the pairs add up to the cut less the share of its tip, down to no depth") {
  for (const Shape& shape : kShapes) {
    for (const double depth : {1e-3, 0.8, 1.999}) {
      INFO(shape.name << ", depth " << depth);
      Block block(shape);
      block.options.constants["depth"] = depth;
      const Mesh mesh = opened(block.mesh());
      const double of_tip = shape.tip_share * depth / 3;  // the last of three elements
      CHECK(sum(mesh.slits[0].areas_m2) == Approx(depth - of_tip).margin(kGrid));
      CHECK(area_m2(mesh, mesh.face_set("cut")) == Approx(depth).margin(kGrid));
    }
  }
}

TEST_CASE("a cut through everything leaves two bodies, all of its area on pairs") {
  for (const Shape& shape : kShapes) {
    INFO(shape.name);
    const Mesh mesh = opened(Block(shape).mesh(), {"whole_plane"});
    CHECK(bodies(mesh) == 2);
    CHECK(sum(mesh.slits[0].areas_m2) == Approx(2).epsilon(kRounding));
  }
}

TEST_CASE("faces follow their elements and node sets hold what they held") {
  for (const Shape& shape : kShapes) {
    INFO(shape.name);
    const Mesh whole = Block(shape).mesh();
    Mesh with_loose_set = whole;
    with_loose_set.node_sets.push_back({"loose", whole.node_set("cut").nodes});
    const Mesh mesh = opened(with_loose_set);

    // Every outside face is still a side of one element; every inside face of two.
    const auto owners = owners_of_sides(mesh);
    for (const auto& [name, count] : {std::pair("outside", 1), {"inner_wall", 2}, {"cut", 1}}) {
      CHECK(area_m2(mesh, mesh.face_set(name)) ==
            Approx(area_m2(whole, whole.face_set(name))).epsilon(kRounding));
      for (const FaceBlock& block : mesh.face_set(name).blocks) {
        const std::size_t n = nodes_per_element(block.kind);
        for (std::size_t f = 0; f < block.size(); ++f) {
          const FacetKey key = key_of_face(block.kind, std::span(block.nodes).subspan(f * n, n));
          REQUIRE(owners.count(key) == 1);
          CHECK(owners.at(key) == count);
        }
      }
    }
    // The mouth's nodes lie on the outside, on both sides of the cut.
    const auto on_mouth = [&](std::int32_t node) {
      const auto& x = mesh.nodes[static_cast<std::size_t>(node)];
      return x[0] == 0 || x[1] == 0 || x[1] > 1 - kRounding;
    };
    const Slit& slit = mesh.slits[0];
    const auto mouth = std::count_if(slit.lower.begin(), slit.lower.end(), on_mouth);
    const auto grown = [&](const char* set) {
      return static_cast<std::ptrdiff_t>(mesh.node_set(set).nodes.size() -
                                         with_loose_set.node_set(set).nodes.size());
    };
    CHECK(grown("outside") == mouth);
    CHECK(grown("cut") == 0);
    CHECK(grown("loose") == static_cast<std::ptrdiff_t>(slit.lower.size()));
  }
}

TEST_CASE("on a curved cut the normals are the surface's own") {
  for (const Shape& shape : kShapes) {
    INFO(shape.name);
    Block block(shape);
    block.options.constants["along"] = 8;
    Mesh mesh = block.mesh();
    // The mesh is rolled up about the line x = 0, z = -2, so that z = 0 becomes a cylinder of
    // radius 2.
    for (auto& x : mesh.nodes) {
      x = {(x[2] + 2) * std::sin(x[0] / 2), x[1], (x[2] + 2) * std::cos(x[0] / 2) - 2};
    }
    mesh = opened(mesh);
    const Slit& slit = mesh.slits[0];
    // Chords rotate by 0.05 rad from element to element: their own normals are wrong by half of it
    // at a node at the mouth; those of quadratic faces by its square at most.
    const double within = order_of(mesh.blocks[0].kind) == 1 ? 0.026 : 0.0025;
    for (std::size_t p = 0; p < slit.lower.size(); ++p) {
      const auto& x = mesh.nodes[static_cast<std::size_t>(slit.lower[p])];
      const Eigen::Vector3d inwards = -Eigen::Vector3d(x[0], 0, x[2] + 2).normalized();
      CHECK((Eigen::Vector3d(slit.normals[p].data()) - inwards).norm() < within);
    }
  }
}

TEST_CASE("a script's slits are cut before patches are taken, open or tied") {
  Block block(kShapes[0]);
  block.options.slits = {"cut"};
  block.options.slits_tied = true;
  block.options.patches = {{"corner", "outside", {{0, 0, 0}}, 1e-6}};
  const Mesh mesh = block.mesh();
  REQUIRE(mesh.slits.size() == 1);
  CHECK(mesh.slits[0].tied);
  CHECK(mesh.node_set("corner").nodes.size() == 2);
  block.options.slits_tied = false;
  CHECK_FALSE(block.mesh().slits[0].tied);
}

TEST_CASE("faces that cannot be a slit are refused and leave the mesh as it was") {
  const Mesh whole = Block(kShapes[0]).mesh();
  const auto refusal = [&](const Mesh& start, const std::vector<std::string>& sets) {
    Mesh mesh = start;
    std::string text;
    try {
      open_slits(mesh, sets, false);
    } catch (const InputError& error) {
      text = error.what();
    }
    CHECK(all_elements(mesh) == all_elements(start));
    CHECK(mesh.nodes.size() == start.nodes.size());
    CHECK(mesh.slits.empty());
    return text;
  };
  CHECK_THAT(refusal(whole, {"outside"}),
             Contains("slit 'outside'") && Contains("an element on both sides"));
  CHECK_THAT(refusal(whole, {"cat"}), Contains("no face set 'cat' (did you mean 'cut'?)"));
  CHECK_THAT(refusal(whole, {"cut", "whole_plane"}), Contains("occurs twice"));
  CHECK_THAT(refusal(whole, {"cut", "rest_of_plane"}),
             Contains("shares nodes with slit 'rest_of_plane'"));
  CHECK_THAT(refusal(whole, {"cut", "cut"}), Contains("'cut'"));
  CHECK_THAT(refusal(whole, {"whole_plane", "inner_wall"}), Contains("meets or crosses a slit"));

  // One face of 8-node hexahedra inside a block: all its nodes lie on the tip.
  Block coarse(kShapes[2]);
  coarse.options.constants = {{"along", 3}, {"beyond", 2}, {"across", 3}, {"shape", 0}};
  Mesh inside = coarse.mesh();
  FaceBlock& faces = inside.face_sets[0].blocks[0];
  REQUIRE(inside.face_sets[0].name == "cut");
  const auto is_inner = [&](std::size_t f) {
    return std::all_of(faces.nodes.begin() + static_cast<std::ptrdiff_t>(4 * f),
                       faces.nodes.begin() + static_cast<std::ptrdiff_t>(4 * f + 4),
                       [&](std::int32_t node) {
                         const auto& x = inside.nodes[static_cast<std::size_t>(node)];
                         return x[0] > 0.1 && x[1] > 0.1 && x[1] < 0.9;
                       });
  };
  std::vector<std::int32_t> one;
  for (std::size_t f = 0; f < faces.size() && one.empty(); ++f) {
    if (is_inner(f))
      one.assign(faces.nodes.begin() + static_cast<std::ptrdiff_t>(4 * f),
                 faces.nodes.begin() + static_cast<std::ptrdiff_t>(4 * f + 4));
  }
  REQUIRE(one.size() == 4);
  faces.nodes = one;
  std::erase_if(inside.node_sets, [](const NodeSet& set) { return set.name == "cut"; });
  CHECK_THAT(refusal(inside, {"cut"}), Contains("no node of its faces is separated"));
}

}  // namespace flexneck::mesher
