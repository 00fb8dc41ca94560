// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/import_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <span>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "mesher/mesh/bounding_box.h"
#include "mesher/mesh/disjoint_sets.h"
#include "mesher/mesh/mesh_measures.h"
#include "mesher/mesh/positions.h"

namespace flexneck::mesher {
namespace {

/// Fraction of the mesh's size: rounding of the numbers in a text file, far below any element.
constexpr double kSamePlace = 1e-9;
/// Scaled Jacobian below which it is only rounding.
constexpr double kDegenerate = 1e-6;

using Point = std::array<double, 3>;

std::string place(const Point& x) { return "(" + rounded_texts(x, 4) + ") m"; }

Point centre_of(const Mesh& mesh, std::span<const std::int32_t> nodes) {
  const Eigen::Vector3d centre = positions_of(mesh, nodes).rowwise().mean();
  return {centre[0], centre[1], centre[2]};
}

/// Calls `visit` with each block and the nodes of each of its elements.
template <class Visit>
void for_each_element(const Mesh& mesh, const Visit& visit) {
  for (const ElementBlock& block : mesh.blocks) {
    const std::size_t n = nodes_per_element(block.kind);
    for (std::size_t first = 0; first < block.nodes.size(); first += n) {
      visit(block, std::span(block.nodes).subspan(first, n));
    }
  }
}

void refuse_doubled_elements(const Mesh& mesh) {
  std::set<std::vector<std::int32_t>> seen;
  std::size_t doubles = 0;
  std::string first;
  for_each_element(mesh, [&](const ElementBlock& block, std::span<const std::int32_t> nodes) {
    std::vector<std::int32_t> sorted(nodes.begin(), nodes.end());
    std::sort(sorted.begin(), sorted.end());
    if (seen.insert(std::move(sorted)).second) return;
    if (doubles++ == 0) {
      first = "part '" + block.part + "' near " + place(centre_of(mesh, nodes));
    }
  });
  if (doubles == 0) return;
  throw InputError(std::to_string(doubles) +
                   " elements have the same nodes as others, the first in " + first +
                   "; remove the duplicates");
}

/// Nodes at the position of another with a smaller index, ascending. Nodes are sorted along a
/// direction in which no mesh has planes, so that nodes at the same position are neighbours.
std::vector<std::int32_t> doubled_nodes(const Mesh& mesh) {
  const double tolerance = kSamePlace * bounding_box(mesh).extent_m().norm();
  const Eigen::Vector3d direction = Eigen::Vector3d(0.8191, 0.5013, 0.2789).normalized();
  const auto positions = positions_of(mesh);
  std::vector<std::pair<double, std::int32_t>> along(mesh.nodes.size());
  for (std::size_t n = 0; n < along.size(); ++n) {
    const auto node = static_cast<std::int32_t>(n);
    along[n] = {direction.dot(positions.col(node)), node};
  }
  std::sort(along.begin(), along.end());
  std::vector<std::int32_t> doubles;
  for (auto one = along.begin(); one != along.end(); ++one) {
    for (auto two = one + 1; two != along.end() && two->first - one->first <= tolerance; ++two) {
      if ((positions.col(one->second) - positions.col(two->second)).norm() > tolerance) continue;
      doubles.push_back(std::max(one->second, two->second));
    }
  }
  std::sort(doubles.begin(), doubles.end());
  doubles.erase(std::unique(doubles.begin(), doubles.end()), doubles.end());
  return doubles;
}

void refuse_doubled_nodes(const Mesh& mesh) {
  const std::vector<std::int32_t> doubles = doubled_nodes(mesh);
  if (doubles.empty()) return;
  const Point& first = mesh.nodes[static_cast<std::size_t>(doubles.front())];
  throw InputError(std::to_string(doubles.size()) + " nodes coincide with others, the first at " +
                   place(first) +
                   ": the parts are not connected there, or are duplicated; merge the nodes, or "
                   "set coincident_nodes = \"keep\" if a gap is intended");
}

/// Joins the nodes that couplings, equations and springs connect.
void join_connected(const Mesh& mesh, DisjointSets& pieces) {
  const Connections& connections = mesh.connections;
  const auto place = [&](std::int32_t site) {  // both sites of a point are one
    const auto s = static_cast<std::size_t>(site);
    return s < mesh.nodes.size() ? s : mesh.nodes.size() + (s - mesh.nodes.size()) / 2;
  };
  const auto join_all = [&](const std::vector<Term>& terms) {
    for (const Term& term : terms) pieces.join(place(terms.front().site), place(term.site));
  };
  for (const Coupling& coupling : connections.couplings) {
    const std::size_t point = mesh.nodes.size() + static_cast<std::size_t>(coupling.point);
    for (const std::int32_t node : coupling.nodes) pieces.join(point, place(node));
  }
  for (const Equation& equation : connections.equations) join_all(equation.terms);
  for (const Spring& spring : connections.springs) join_all(spring.terms);
}

void refuse_unconnected(const Mesh& mesh) {
  DisjointSets pieces(mesh.nodes.size() + mesh.connections.points.size());
  const auto member = [](std::int32_t node) { return static_cast<std::size_t>(node); };
  for_each_element(mesh, [&](const ElementBlock&, std::span<const std::int32_t> nodes) {
    for (const std::int32_t node : nodes) pieces.join(member(nodes.front()), member(node));
  });
  join_connected(mesh, pieces);
  std::set<std::size_t> roots;
  std::string second;
  for_each_element(mesh, [&](const ElementBlock& block, std::span<const std::int32_t> nodes) {
    if (!roots.insert(pieces.root(member(nodes.front()))).second || roots.size() != 2) return;
    second = "part '" + block.part + "' near " + place(centre_of(mesh, nodes));
  });
  if (roots.size() < 2) return;
  throw InputError("the mesh consists of " + std::to_string(roots.size()) +
                   " unconnected pieces, the second with " + second +
                   "; connect them, or use a mesh of a single piece");
}

void refuse_inverted(const Mesh& mesh) {
  for (const ElementBlock& block : mesh.blocks) {
    const std::vector<double> scaled = scaled_jacobians(mesh, block);
    const auto count = static_cast<std::size_t>(std::count_if(
        scaled.begin(), scaled.end(), [](double value) { return !(value > kDegenerate); }));
    if (count == 0) continue;
    const auto worst_element =
        static_cast<std::size_t>(std::min_element(scaled.begin(), scaled.end()) - scaled.begin());
    const std::size_t n = nodes_per_element(block.kind);
    const Point worst = centre_of(mesh, std::span(block.nodes).subspan(worst_element * n, n));
    throw InputError(
        "part '" + block.part + "': " + std::to_string(count) + " of " +
        std::to_string(block.size()) + " elements (" + std::string(name_of(block.kind)) +
        ") are inverted or degenerate, the worst near " + place(worst) +
        (count == block.size()
             ? "; since all are, the mesh is mirrored, or its nodes are in another order"
             : "; repair the mesh"));
  }
}

}  // namespace

void check_import(const Mesh& mesh, bool keeps_doubles) {
  refuse_doubled_elements(mesh);
  if (!keeps_doubles) refuse_doubled_nodes(mesh);
  refuse_unconnected(mesh);
  refuse_inverted(mesh);
}

}  // namespace flexneck::mesher
