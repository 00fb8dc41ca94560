// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <numeric>

#include <catch2/catch.hpp>

#include "fe_modal/solve/iterative/subdomains.h"
#include "fe_modal/system/assembly.h"
#include "tests/support/block_mesh.h"

namespace flexneck::fe_modal {
namespace {

/// Rubber, metal and two rubbers more, two layers of elements each, one unit high.
mesher::Mesh layers() {
  testing::BlockMesh box = testing::box({2, 1, 1}, {1, 1, 1}, {"soft", 8e6, 0.49, 950});
  box.slices = {{"lower", 2, {"soft", 8e6, 0.49, 950}},
                {"plate", 2, {"metal", 7e10, 0.3, 2700}},
                {"upper", 2, {"softer", 5e6, 0.49, 950}},
                {"pad", 2, {"softest", 2e6, 0.49, 950}}};
  return box.make();
}

struct Range {
  double lowest = 0;
  double highest = 0;
};

Range range_of(const std::vector<double>& values) {
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  return {*lowest, *highest};
}

}  // namespace

TEST_CASE("subdomains overlap by a layer of elements, but not into material that is much stiffer") {
  const mesher::Mesh mesh = layers();
  const DofMap dof_map(mesh, {});
  const Subdomains subdomains = find_subdomains(mesh, dof_map);
  const SystemMatrices system = assemble(mesh, dof_map);
  std::vector<std::int32_t> blocks(static_cast<std::size_t>(dof_map.free_count()));
  std::iota(blocks.begin(), blocks.end(), 0);
  std::vector<double> heights(blocks.size());
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    dof_map.for_each_number(static_cast<std::int32_t>(node), [&](std::int32_t block) {
      heights[static_cast<std::size_t>(block)] = 8 * mesh.nodes[node][2];
    });
  }
  // Nodes on the far side of the layer are in it where it is much softer.
  const std::vector<Range> expected = {{0, 2}, {1, 5}, {4, 6.5}, {5.5, 8}};
  REQUIRE(subdomains.blocks.size() == expected.size());
  for (std::size_t s = 0; s < expected.size(); ++s) {
    std::vector<double> reached;
    for (const std::int32_t row : extended(subdomains, s, system.graph, blocks)) {
      reached.push_back(heights[static_cast<std::size_t>(row)]);
    }
    const Range range = range_of(reached);
    CHECK(range.lowest == Approx(expected[s].lowest).margin(1e-9));
    CHECK(range.highest == Approx(expected[s].highest));
    const auto count = std::count_if(heights.begin(), heights.end(), [&](double height) {
      return height > range.lowest - 1e-9 && height < range.highest + 1e-9;
    });
    CHECK(reached.size() == static_cast<std::size_t>(count));
  }
}

}  // namespace flexneck::fe_modal
