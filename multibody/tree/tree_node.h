// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "multibody/model/model.h"
#include "multibody/model/stress_stiffening.h"

namespace flexneck::multibody::tree {

/// Where a marker sits on its body. A rigid or prescribed body's has no columns in psi and mu.
struct TreeNode {
  TreeNode() = default;
  TreeNode(const Body& body, const Marker& marker);

  Eigen::Vector3d s0 = Eigen::Vector3d::Zero();  ///< body axes
  Eigen::Matrix3Xd psi{3, 0};
  Eigen::Matrix3Xd mu{3, 0};
  NodeSlopes slopes;                                 ///< empty without stress stiffening
  Eigen::Matrix3d R0 = Eigen::Matrix3d::Identity();  ///< marker axes to body axes, undeformed
  bool moves = false;                                ///< with the modes
  bool at_origin = true;                             ///< of the body, whatever its modes do
};

/// Its place and motion seen from the body, in body axes (equations.md section 7).
struct NodeMotion {
  explicit NodeMotion(const TreeNode& node);

  Eigen::Vector3d s;     ///< position
  Eigen::Matrix3d R;     ///< marker axes to body axes
  Eigen::Matrix3Xd psi;  ///< (3, m): velocity against the body by the modal rates
  Eigen::Matrix3Xd jm;   ///< (3, m): angular velocity against the body by the modal rates
  Eigen::Vector3d s_dot = Eigen::Vector3d::Zero();
  Eigen::Vector3d s_dot_rate = Eigen::Vector3d::Zero();  ///< of `s_dot`, while the rates stay
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();        ///< angular velocity against the body
  Eigen::Vector3d turn_rate = Eigen::Vector3d::Zero();   ///< of `turn`, while the rates stay
  Eigen::Matrix3Xd mu;  ///< (3, m): rate of the rotation vector by the modal rates
};

void update(const TreeNode& node, const Eigen::VectorXd& a, const Eigen::VectorXd& a_rate,
            NodeMotion& motion);

}  // namespace flexneck::multibody::tree
