// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// Distribution of the elements of a mesh over processes.
struct ElementPartition {
  int count = 1;                        ///< number of processes, k
  std::vector<std::int32_t> processes;  ///< (elements) 0 … k - 1, blocks in the mesh's order
};

struct PartitionQuality {
  std::int64_t edge_cut = 0;  ///< pairs of elements with a common facet in two processes
  double balance = 1;         ///< largest number of elements of a process over the average
};

/// Partitions the dual graph, in which elements with a common facet are neighbours, by METIS's
/// recursive bisection (Karypis and Kumar, SIAM J. Sci. Comput. 20 (1998) 359). Equal input gives
/// the same partition; a process may remain without elements if there are hardly more elements than
/// processes.
/// @throws InputError unless 1 <= count <= number of elements.
/// @throws ComputationError if METIS fails.
ElementPartition partition_elements(const Mesh& mesh, int count);

/// Quality of a partition, counted on the mesh, not taken from METIS's report.
/// @pre the partition is one of this mesh.
PartitionQuality quality_of(const Mesh& mesh, const ElementPartition& partition);

}  // namespace flexneck::mesher
