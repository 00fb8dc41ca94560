// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "multibody/model/model.h"
#include "multibody/model/stress_stiffening.h"

namespace flexneck::multibody::tree {

/// Placement of a marker on its body. That on a rigid or prescribed body has no columns in psi and
/// mu.
struct TreeNode {
  TreeNode() = default;
  TreeNode(const Body& body, const Marker& marker);

  Eigen::Vector3d s0 = Eigen::Vector3d::Zero();  ///< body axes
  Eigen::Matrix3Xd psi{3, 0};
  Eigen::Matrix3Xd mu{3, 0};
  NodeSlopes slopes;                                 ///< empty without stress stiffening
  Eigen::Matrix3d R0 = Eigen::Matrix3d::Identity();  ///< marker axes to body axes, undeformed
  bool moves = false;                                ///< it moves with the modes
  bool at_origin = true;  ///< it coincides with the body's origin, whatever its modes do
};

/// Position and motion of a node relative to the body, in body axes (equations.md section 7).
struct NodeMotion {
  explicit NodeMotion(const TreeNode& node);

  Eigen::Vector3d s;     ///< position
  Eigen::Matrix3d R;     ///< marker axes to body axes
  Eigen::Matrix3Xd psi;  ///< (3, m): velocity relative to the body by the modal rates
  Eigen::Matrix3Xd jm;   ///< (3, m): angular velocity relative to the body by the modal rates
  Eigen::Vector3d s_dot = Eigen::Vector3d::Zero();
  Eigen::Vector3d s_dot_rate = Eigen::Vector3d::Zero();  ///< rate of `s_dot`, at constant rates
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();        ///< angular velocity relative to the body
  Eigen::Vector3d turn_rate = Eigen::Vector3d::Zero();   ///< rate of `turn`, at constant rates
  Eigen::Matrix3Xd mu;  ///< (3, m): rate of the rotation vector by the modal rates
};

void update(const TreeNode& node, const Eigen::VectorXd& a, const Eigen::VectorXd& a_rate,
            NodeMotion& motion);

}  // namespace flexneck::multibody::tree
