// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/algebra/nodal_mass.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Body forces rho g; for accelerating supports g is the negative of their acceleration.
struct GravityLoad {
  Eigen::Vector3d acceleration_m_s2;
};

/// Traction on a face set, linear in position, with the given resultant: the work-conjugate of the
/// faces' mean motion (rigid_average.h), so that under a force at the centroid it is uniform.
struct FaceLoad {
  std::string set;
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment_Nm = Eigen::Vector3d::Zero();
  /// Point of the force; default: centroid.
  std::optional<Eigen::Vector3d> position_m = std::nullopt;
};

/// Pressure normal to the boundary of the body; positive if it pushes on the body.
struct PressureLoad {
  std::string set;  ///< a face set
  double pressure_Pa = 0;
};

/// The same force on each node of a set, or on the node at a position.
struct NodeLoad {
  std::string set;                                           ///< a node set; empty: by position
  std::optional<Eigen::Vector3d> position_m = std::nullopt;  ///< within 1e-6 of the body's size
  Eigen::Vector3d force_N;
};

/// Motion of supported nodes, in their fixed directions: u = translation + rotation x (x -
/// position).
struct SupportLoad {
  std::string set;  ///< a node set; its nodes are fixed
  Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();  ///< small
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
};

/// A load of a linear static step.
struct Load {
  std::string name;
  std::variant<GravityLoad, FaceLoad, PressureLoad, NodeLoad, SupportLoad> kind;
};

/// Text of a load: "pull: face 'tip', force (0, 0, 100) N at (0, 0, 1) m".
std::string describe(const Load& load);

/// Consistent nodal forces of all loads, (3, n) in N, without those of moving supports and the
/// weights of masses at reference points (point_forces.h).
/// @param nodal_mass mass between all nodes
/// @throws InputError for an unknown set, a position without a node, or a pressure on faces that
/// are not on the boundary, naming the load.
Eigen::Matrix3Xd nodal_forces(const mesher::Mesh& mesh, const NodalMass& nodal_mass,
                              const std::vector<Load>& loads);

}  // namespace flexneck::fe_modal
