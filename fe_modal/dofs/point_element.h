// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "mesher/mesh/connections.h"

namespace flexneck::fe_modal {

/// A point mass or a spring, as an element on n sites. Degree of freedom a n + i is direction a of
/// site i.
struct PointElement {
  std::vector<std::int32_t> sites;
  Eigen::MatrixXd stiffness;  ///< (3n, 3n), N/m
  Eigen::MatrixXd mass;       ///< (3n, 3n), kg
};

/// Elements of all connections of a mesh. A rigid body at a reference point has the sites of its
/// translation and rotation.
std::vector<PointElement> point_elements_of(const mesher::Connections& connections,
                                            std::size_t node_count);

}  // namespace flexneck::fe_modal
