// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/body/stress.h"

namespace flexneck::fe_modal {

/// Stresses at the nodes of one material: extrapolated in each element from its integration points,
/// then averaged over the elements of this material that share the node.
struct NodalStresses {
  std::string material;
  std::vector<std::int32_t> nodes;  ///< (k), ascending
  Stresses stress_Pa;               ///< (6, k)
};

/// Stresses at the integration points of the elements of one part and kind, element by element.
struct PointStresses {
  std::string part;
  std::string kind;  ///< kind of element, such as "hex20"
  int points_per_element = 0;
  Eigen::Matrix3Xd positions_m;  ///< (3, elements x points)
  Stresses stress_Pa;            ///< (6, elements x points)
};

/// Resultant of nodal forces about the origin.
struct Resultant {
  Eigen::Vector3d force_N;
  Eigen::Vector3d moment_Nm;
};
/// @param nodes_m (3, n) @param forces_N (3, n)
Resultant resultant_of(const Eigen::Matrix3Xd& nodes_m, const Eigen::Matrix3Xd& forces_N);

/// Result of a linear static step: small displacements, K u = f.
struct StaticSolution {
  std::string boundary;              ///< supports, e.g. "fixed: bolts"
  std::string solver;                ///< method of solution of K u = f
  std::vector<std::string> loads;    ///< description of each load, with its name
  double imbalance = 0;              ///< norm of f - K u on the free nodes over that of the loads
  Eigen::Matrix3Xd nodes_m;          ///< (3, n)
  Eigen::Matrix3Xd displacements_m;  ///< (3, n)
  Eigen::Matrix3Xd applied_N;        ///< (3, n), consistent nodal forces of the loads
  Eigen::Matrix3Xd reactions_N;      ///< (3, n), of supports and connections on nodes
  std::vector<NodalStresses> at_nodes;   ///< one for each material
  std::vector<PointStresses> at_points;  ///< one for each part and kind of element
};

}  // namespace flexneck::fe_modal
