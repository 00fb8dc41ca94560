// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <numeric>
#include <set>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "mesher/partition/element_partition.h"
#include "tests/support/block_mesh.h"

namespace flexneck::mesher {
namespace {

const Material kMaterial{
    .name = "any", .youngs_modulus_Pa = 1e9, .poissons_ratio = 0.3, .density_kg_m3 = 1000};

Mesh box_of(int x, int y, int z) {
  return testing::box({x, y, z}, Eigen::Vector3d(x, y, z), kMaterial).make();
}

}  // namespace

TEST_CASE("a bar is cut once for each further process, into equal pieces") {
  const Mesh bar = box_of(1, 1, 24);
  for (const int count : {2, 3, 4}) {
    const ElementPartition partition = partition_elements(bar, count);
    const PartitionQuality quality = quality_of(bar, partition);
    CHECK(partition.processes.size() == 24);
    CHECK(std::set(partition.processes.begin(), partition.processes.end()).size() ==
          static_cast<std::size_t>(count));
    CHECK(quality.edge_cut == count - 1);
    CHECK(quality.balance == 1);
  }
}

TEST_CASE("a cube is halved by hardly more than a plane of sides") {
  const Mesh cube = box_of(10, 10, 10);
  const PartitionQuality quality = quality_of(cube, partition_elements(cube, 2));
  CHECK(quality.edge_cut >= 100);
  CHECK(quality.edge_cut <= 130);
  CHECK(quality.balance <= 1.03);  // METIS's own tolerance
}

TEST_CASE("the cut counts the pairs of neighbours on two processes") {
  const Mesh cube = box_of(2, 2, 2);
  // Elements are numbered along x, y, z: a checkerboard separates all twelve pairs.
  const ElementPartition checkerboard{2, {0, 1, 1, 0, 1, 0, 0, 1}};
  CHECK(quality_of(cube, checkerboard).edge_cut == 12);
  const ElementPartition uneven{2, {1, 0, 0, 0, 0, 0, 0, 0}};
  CHECK(quality_of(cube, uneven).edge_cut == 3);
  CHECK(quality_of(cube, uneven).balance == 1.75);
}

TEST_CASE("one process has everything, and the same mesh gives the same partition") {
  const Mesh cube = box_of(6, 5, 4);
  CHECK(quality_of(cube, partition_elements(cube, 1)).edge_cut == 0);
  CHECK(partition_elements(cube, 3).processes == partition_elements(cube, 3).processes);
}

TEST_CASE("as many processes as elements have one each") {
  for (const int count : {2, 3, 5}) {
    const Mesh bar = box_of(1, 1, count);
    std::vector<std::int32_t> processes = partition_elements(bar, count).processes;
    std::sort(processes.begin(), processes.end());
    std::vector<std::int32_t> each(static_cast<std::size_t>(count));
    std::iota(each.begin(), each.end(), 0);
    CHECK(processes == each);
  }
}

TEST_CASE("a number of processes without sense is refused with the bounds") {
  const Mesh pair = box_of(1, 1, 2);
  CHECK_THROWS_AS(partition_elements(pair, 0), InputError);
  CHECK_THROWS_WITH(partition_elements(pair, 3), Catch::Contains("expected 1 to 2"));
}

}  // namespace flexneck::mesher
