// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/tree/tree_node.h"

#include "multibody/rotation.h"

namespace flexneck::multibody::tree {

using Eigen::Matrix3d;
using Eigen::Vector3d;

TreeNode::TreeNode(const Body& body, const Marker& marker)
    : s0(marker.position_m), R0(marker.rotation.normalized()) {
  if (const auto* deformable = std::get_if<DeformableBody>(&body.kind)) {
    const fe_modal::Interface& place = deformable->modes.interface(marker.interface);
    s0 = place.position_m;
    psi = place.translation;
    mu = place.rotation;
    moves = !(psi.isZero(0) && mu.isZero(0));
  }
  at_origin = !moves && s0.isZero(0);
}

NodeMotion::NodeMotion(const TreeNode& node)
    : s(node.s0), R(node.R0), jm(Eigen::Matrix3Xd::Zero(3, node.mu.cols())) {}

void update(const TreeNode& node, const Eigen::VectorXd& a, const Eigen::VectorXd& a_rate,
            NodeMotion& motion) {
  if (!node.moves) return;
  Vector3d theta = Vector3d::Zero();
  Vector3d theta_dot = Vector3d::Zero();
  motion.s = node.s0;
  motion.s_dot.setZero();
  for (Eigen::Index l = 0; l < a.size(); ++l) {
    motion.s += a[l] * node.psi.col(l);
    motion.s_dot += a_rate[l] * node.psi.col(l);
    theta += a[l] * node.mu.col(l);
    theta_dot += a_rate[l] * node.mu.col(l);
  }
  // From the quaternion of the rotation: turn = p theta' + c (theta . theta') theta
  // + b theta x theta' with p = sin t / t = 1 - c t^2, and its rate while theta' stays.
  const double u = theta.squaredNorm();
  const RotationCoefficients k = rotation_coefficients(u);
  const double along = theta.dot(theta_dot);
  const Vector3d across = theta.cross(theta_dot);
  motion.turn = k.a * theta_dot + (k.c * along) * theta + k.b * across;
  motion.turn_rate = -(k.c + u * k.c_rate) * along * theta_dot +
                     (k.c_rate * along * along + k.c * theta_dot.squaredNorm()) * theta +
                     (k.b_rate * along) * across;
  for (Eigen::Index l = 0; l < a.size(); ++l) {
    const Vector3d column = node.mu.col(l);
    motion.jm.col(l) = k.a * column + (k.c * theta.dot(column)) * theta + k.b * theta.cross(column);
  }
  // cos t I + (sin t / t) ~theta + b theta theta^T.
  Matrix3d turned = k.b * theta * theta.transpose() + k.a * skew(theta);
  turned.diagonal().array() += 1 - k.b * u;
  motion.R.noalias() = turned * node.R0;
}

}  // namespace flexneck::multibody::tree
