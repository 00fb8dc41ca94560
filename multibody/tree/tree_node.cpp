// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/tree/tree_node.h"

#include "multibody/numerics/rotation.h"

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
    slopes = node_slopes(*deformable, marker.interface);
    moves = !(psi.isZero(0) && mu.isZero(0));
  }
  at_origin = !moves && s0.isZero(0);
}

NodeMotion::NodeMotion(const TreeNode& node)
    : s(node.s0),
      R(node.R0),
      psi(node.psi),
      jm(Eigen::Matrix3Xd::Zero(3, node.mu.cols())),
      mu(node.mu) {}

void update(const TreeNode& node, const Eigen::VectorXd& a, const Eigen::VectorXd& a_rate,
            NodeMotion& motion) {
  if (!node.moves) return;
  Vector3d theta = Vector3d::Zero();
  Vector3d theta_dot = Vector3d::Zero();
  motion.s = node.s0;
  motion.s_dot.setZero();
  const bool stiffens = node.slopes.psi.size() > 0;
  if (stiffens) {
    motion.psi = node.psi;
    motion.mu = node.mu;
    add_slopes(node.slopes.psi, a, motion.psi);
    add_slopes(node.slopes.mu, a, motion.mu);
    // The slopes' contribution, which is in psi(a) a and mu(a) a, counts only by half.
    for (Eigen::Index l = 0; l < a.size(); ++l) {
      motion.s += (0.5 * a[l]) * (node.psi.col(l) - motion.psi.col(l));
      theta += (0.5 * a[l]) * (node.mu.col(l) - motion.mu.col(l));
    }
  }
  for (Eigen::Index l = 0; l < a.size(); ++l) {
    motion.s += a[l] * motion.psi.col(l);
    motion.s_dot += a_rate[l] * motion.psi.col(l);
    theta += a[l] * motion.mu.col(l);
    theta_dot += a_rate[l] * motion.mu.col(l);
  }
  // From the quaternion of the rotation: turn = p theta' + c (theta . theta') theta + b theta x
  // theta' with p = sin t / t = 1 - c t^2, and its rate at constant theta'.
  const double u = theta.squaredNorm();
  const RotationCoefficients k = rotation_coefficients(u);
  const double along = theta.dot(theta_dot);
  const Vector3d across = theta.cross(theta_dot);
  motion.turn = k.a * theta_dot + (k.c * along) * theta + k.b * across;
  motion.turn_rate = -(k.c + u * k.c_rate) * along * theta_dot +
                     (k.c_rate * along * along + k.c * theta_dot.squaredNorm()) * theta +
                     (k.b_rate * along) * across;
  for (Eigen::Index l = 0; l < a.size(); ++l) {
    const Vector3d column = motion.mu.col(l);
    motion.jm.col(l) = k.a * column + (k.c * theta.dot(column)) * theta + k.b * theta.cross(column);
  }
  if (stiffens) {
    motion.s_dot_rate = contracted(node.slopes.psi, a_rate, a_rate);
    const Vector3d curved = contracted(node.slopes.mu, a_rate, a_rate);
    motion.turn_rate +=
        k.a * curved + (k.c * theta.dot(curved)) * theta + k.b * theta.cross(curved);
  }
  // Rotation matrix cos t I + (sin t / t) ~theta + b theta theta^T.
  Matrix3d turned = k.b * theta * theta.transpose() + k.a * skew(theta);
  turned.diagonal().array() += 1 - k.b * u;
  motion.R.noalias() = turned * node.R0;
}

}  // namespace flexneck::multibody::tree
