// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "fe_modal/body/static_solution.h"
#include "fe_modal/element/formulation.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Map from values at the q points of an element's stiffness to its n nodes, (n, q): the function
/// of the element's corners (linear, on a hexahedron trilinear) that fits the values best in the
/// least-squares sense, at the nodes. It reproduces constants exactly, and with as many points as
/// corners also linear functions of an undistorted element.
Eigen::MatrixXd extrapolation_to_nodes(const ElementScheme& scheme);

/// Stresses of a displacement field at all integration points and at the nodes of each material.
struct StressFields {
  std::vector<NodalStresses> at_nodes;
  std::vector<PointStresses> at_points;
};
/// @param displacements_m displacements of all nodes, (3, n)
StressFields stress_fields(const mesher::Mesh& mesh, const FormulationChoice& formulation,
                           const Eigen::Matrix3Xd& displacements_m);

}  // namespace flexneck::fe_modal
