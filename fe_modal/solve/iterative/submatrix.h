// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/algebra/symmetric_matrix.h"
#include "fe_modal/dofs/node_graph.h"

namespace flexneck::fe_modal {

/// The graph between some of the nodes, by their places in the list.
/// @param nodes ascending
NodeGraph restrict_to(const NodeGraph& graph, const std::vector<std::int32_t>& nodes);

/// The rows and columns of some nodes.
/// @param part graph between them
SymmetricMatrix principal_part(const SymmetricMatrix& matrix, const NodeGraph& part,
                               const std::vector<std::int32_t>& nodes);

/// The rows of one node and the columns of another.
/// @pre they are neighbours, or the same
Eigen::Matrix3d coupling(const SymmetricMatrix& matrix, std::int32_t row, std::int32_t column);

/// Where values are in a list that has them; both ascend.
std::vector<std::int32_t> places_in(const std::vector<std::int32_t>& list,
                                    const std::vector<std::int32_t>& values);

}  // namespace flexneck::fe_modal
