// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/descriptor/node_kinematics.h"

#include "multibody/numerics/rotation.h"

namespace flexneck::multibody {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

NodeConstants::NodeConstants(const Body& body, const Marker& marker)
    : s0(marker.position_m), psi(3, 0), mu(3, 0), R0(marker.rotation.normalized()) {
  if (const auto* deformable = std::get_if<DeformableBody>(&body.kind)) {
    const fe_modal::Interface& place = deformable->modes.interface(marker.interface);
    s0 = place.position_m;
    psi = place.translation;
    mu = place.rotation;
    slopes = node_slopes(*deformable, marker.interface);
    moves = !(psi.isZero(0) && mu.isZero(0));
  }
}

NodeKinematics::NodeKinematics(Index velocity_count)
    : theta(Vector3d::Zero()),
      P(Matrix3Xd::Zero(3, velocity_count)),
      W(Matrix3Xd::Zero(3, velocity_count)),
      psi(3, velocity_count > 6 ? velocity_count - 6 : 0),
      mu(psi),
      Jl_mu(psi) {
  if (velocity_count > 0) P.leftCols<3>().setIdentity();
}

void update_configuration(const NodeConstants& node, const BodyTerms& body,
                          NodeKinematics& motion) {
  const Matrix3d& A = body.A;
  motion.s = node.s0;
  Matrix3d turned = A;
  if (node.moves) {
    const Index m = node.psi.cols();
    motion.s.noalias() += node.psi * body.a;
    motion.theta.noalias() = node.mu * body.a;
    motion.psi = node.psi;
    motion.mu = node.mu;
    if (node.slopes.psi.size() > 0) {
      motion.s += 0.5 * contracted(node.slopes.psi, body.a, body.a);
      motion.theta += 0.5 * contracted(node.slopes.mu, body.a, body.a);
      add_slopes(node.slopes.psi, body.a, motion.psi);
      add_slopes(node.slopes.mu, body.a, motion.mu);
    }
    motion.Jl_mu.noalias() = left_jacobian(motion.theta) * motion.mu;
    motion.P.rightCols(m).noalias() = A * motion.psi;
    motion.W.rightCols(m).noalias() = A * motion.Jl_mu;
    turned = A * rotation_exp(motion.theta);
  }
  motion.p = body.x + A * motion.s;
  motion.R = turned * node.R0;
  motion.P.middleCols<3>(3) = -A * skew(motion.s);
  motion.W.middleCols<3>(3) = A;
}

void update_velocities(const NodeConstants& node, const BodyTerms& body,
                       const Eigen::Ref<const Eigen::VectorXd>& velocity, NodeKinematics& motion) {
  const Matrix3d& A = body.A;
  const Vector3d w = velocity.segment<3>(3);
  const Vector3d turning = w.cross(motion.s);
  if (!node.moves) {
    motion.pd = velocity.head<3>() + A * turning;
    motion.Om = A * w;
    motion.gp = A * w.cross(turning);
    motion.gr.setZero();
    return;
  }
  const auto adot = velocity.tail(node.psi.cols());
  const Vector3d sdot = motion.psi * adot;
  const Vector3d theta_rate = motion.mu * adot;
  const Vector3d w_n = motion.Jl_mu * adot;
  const Vector3d C_n = left_jacobian_rate_times_rate(motion.theta, theta_rate);
  motion.pd = velocity.head<3>() + A * (turning + sdot);
  motion.Om = A * (w + w_n);
  motion.gp = A * w.cross(turning + 2 * sdot);
  motion.gr = A * (w.cross(w_n) + C_n);
  if (node.slopes.psi.size() > 0) {
    motion.gp += A * contracted(node.slopes.psi, adot, adot);
    motion.gr += A * (left_jacobian(motion.theta) * contracted(node.slopes.mu, adot, adot));
  }
}

}  // namespace flexneck::multibody
