// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <numeric>
#include <set>

#include <catch2/catch.hpp>

#include "mesher/partition/node_order.h"
#include "tests/support/block_mesh.h"

namespace flexneck::mesher {
namespace {

using Order = std::vector<std::int32_t>;

struct Graph {
  std::vector<std::int32_t> offsets = {0};
  std::vector<std::int32_t> columns;
};

/// A square grid of n x n vertices, each with a loop and its neighbours in the four directions.
Graph grid(int n) {
  Graph graph;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      for (const auto& [di, dj] : {std::pair{0, -1}, {-1, 0}, {0, 0}, {1, 0}, {0, 1}}) {
        if (i + di < 0 || i + di >= n || j + dj < 0 || j + dj >= n) continue;
        graph.columns.push_back(i + di + n * (j + dj));
      }
      graph.offsets.push_back(static_cast<std::int32_t>(graph.columns.size()));
    }
  }
  return graph;
}

/// Number of entries of the Cholesky factor's lower triangle, by eliminating vertex after vertex.
std::size_t factor_entries(const Graph& graph, const Order& order) {
  const std::size_t n = order.size();
  std::vector<std::size_t> place(n);
  for (std::size_t k = 0; k < n; ++k) place[static_cast<std::size_t>(order[k])] = k;
  std::vector<std::set<std::size_t>> later(n);
  for (std::size_t v = 0; v < n; ++v) {
    for (std::int32_t k = graph.offsets[v]; k < graph.offsets[v + 1]; ++k) {
      const std::size_t other =
          place[static_cast<std::size_t>(graph.columns[static_cast<std::size_t>(k)])];
      if (other > place[v]) later[place[v]].insert(other);
    }
  }
  std::size_t entries = n;
  for (std::size_t k = 0; k < n; ++k) {
    entries += later[k].size();
    if (later[k].empty()) continue;
    // The vertex's remaining neighbourhood becomes a clique; its first member stores it.
    const std::size_t next = *later[k].begin();
    later[next].insert(std::next(later[k].begin()), later[k].end());
  }
  return entries;
}

bool is_permutation_of_all(Order order, std::size_t n) {
  Order natural(n);
  std::iota(natural.begin(), natural.end(), 0);
  std::sort(order.begin(), order.end());
  return order == natural;
}

}  // namespace

TEST_CASE("nested dissection fills a grid's factor far less than the natural order") {
  constexpr std::size_t kSize = 64;
  const Graph graph = grid(static_cast<int>(kSize));
  const Order order = nested_dissection(graph.offsets, graph.columns);
  REQUIRE(is_permutation_of_all(order, kSize * kSize));
  Order natural = order;
  std::sort(natural.begin(), natural.end());
  const std::size_t banded = factor_entries(graph, natural);
  // Row by row, column k couples with n vertices ahead: fewer in the first row and in the last.
  CHECK(banded ==
        kSize * kSize * (kSize + 1) - kSize * (kSize + 1) / 2 - (kSize - 1) * (kSize - 2) / 2);
  // George's dissection leaves at most 31/4 n^2 log2 n (SIAM J. Numer. Anal. 10 (1973) 345), here
  // 0.7 of the band; METIS's separators are better.
  CHECK(factor_entries(graph, order) < banded / 3);
}

TEST_CASE("an order by corners alone fills hardly more than one by all nodes") {
  const Material material{
      .name = "any", .youngs_modulus_Pa = 1e9, .poissons_ratio = 0.3, .density_kg_m3 = 1000};
  const Mesh mesh = testing::box({6, 5, 7}, {6, 5, 7}, material).make();
  std::vector<std::set<std::int32_t>> neighbours(mesh.nodes.size());
  const ElementBlock& block = mesh.blocks[0];
  for (std::size_t e = 0; e < block.size(); ++e) {
    const auto first = block.nodes.begin() + static_cast<std::ptrdiff_t>(27 * e);
    for (auto node = first; node != first + 27; ++node) {
      neighbours[static_cast<std::size_t>(*node)].insert(first, first + 27);
    }
  }
  Graph graph;
  for (const auto& row : neighbours) {
    graph.columns.insert(graph.columns.end(), row.begin(), row.end());
    graph.offsets.push_back(static_cast<std::int32_t>(graph.columns.size()));
  }
  const Order order = nested_dissection(mesh);
  REQUIRE(is_permutation_of_all(order, mesh.nodes.size()));
  Order natural = order;
  std::sort(natural.begin(), natural.end());
  const std::size_t by_nodes =
      factor_entries(graph, nested_dissection(graph.offsets, graph.columns));
  CHECK(factor_entries(graph, order) < factor_entries(graph, natural));
  CHECK(static_cast<double>(factor_entries(graph, order)) < 1.2 * static_cast<double>(by_nodes));
  CHECK(order == nested_dissection(mesh));
}

}  // namespace flexneck::mesher
