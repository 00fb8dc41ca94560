// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "fe_modal/dofs/dof_map.h"
#include "fe_modal/system/loads.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Weights of the masses at reference points under the loads' gravity, on the free degrees of
/// freedom (dof_count()); weights of masses at nodes are nodal forces (loads.h).
Eigen::VectorXd weights_at_points(const mesher::Mesh& mesh, const DofMap& dof_map,
                                  const std::vector<Load>& loads);

/// The same weights transferred to nodes, (3, n) in N: the smallest forces with their resultants on
/// the nodes that couplings, equations and springs join to each point, or through other points if
/// it has none.
Eigen::Matrix3Xd weights_on_nodes(const mesher::Mesh& mesh, const mesher::Connections& connections,
                                  const std::vector<Load>& loads);

/// Spring forces K_springs q under free values q, (dof_count()).
Eigen::VectorXd spring_forces(const mesher::Mesh& mesh, const DofMap& dof_map,
                              const Eigen::VectorXd& free_values);

}  // namespace flexneck::fe_modal
