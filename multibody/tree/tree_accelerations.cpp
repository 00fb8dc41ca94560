// SPDX-License-Identifier: GPL-3.0-or-later
// Outward pass of the recursion: eliminated accelerations are computed from the body before.
#include "multibody/tree/spatial.h"
#include "multibody/tree/tree_dynamics.h"

namespace flexneck::multibody::tree {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Acceleration of a node of a body.
Vector6d node_acceleration(const TreeNode& node, const NodeMotion& motion,
                           const Vector6d& of_origin, const VectorXd& a_acceleration,
                           const Vector3d& w) {
  Vector6d result = carried(of_origin, motion.s) + node_bias(motion, w);
  if (!node.moves) return result;
  for (Index l = 0; l < a_acceleration.size(); ++l) {
    result.head<3>() += a_acceleration[l] * motion.psi.col(l);
    result.tail<3>() += a_acceleration[l] * motion.jm.col(l);
  }
  return result;
}

/// An empty vector for nodes of bodies that do not deform.
const VectorXd& no_modes() {
  static const VectorXd none;
  return none;
}

}  // namespace

void TreeDynamics::accelerate(const TreeBody& body, Work& work) {
  const Index m = body.inertia.mode_count();
  const Index nu = body.joint.velocity_count();
  const Frame& carrier = frame_of(body.carrier);
  const bool deforms = body.carrier.body != kNone;
  const Vector6d at_F =
      node_acceleration(body.inner, work.inner, carrier.acceleration,
                        deforms ? work_[body.carrier.body].a_acceleration : no_modes(), carrier.w);
  Vector6d at_M = rotated(work.R.transpose(), carried(at_F, work.d)) + work.joint_bias;

  // Joint: u' = L^-T (residual - U^T a), with U and residual scaled by L^-1 already.
  auto u_rate = accelerations_.segment(body.velocity, nu);
  for (Index k = nu; k-- > 0;) {
    double value = work.residual[k] - work.U.col(k).dot(at_M);
    for (Index l = k + 1; l < nu; ++l) value -= work.D(l, k) * u_rate[l];
    u_rate[k] = value * work.D(k, k);
  }
  for (Index k = 0; k < nu; ++k) at_M += u_rate[k] * work.S.col(k);

  // Modes: a'' = -L^-T (Y a_M + z).
  for (Index k = m; k-- > 0;) {
    double value = -(work.coupling.col(k).dot(at_M) + work.z[k]);
    for (Index l = k + 1; l < m; ++l) value -= work.terms.M_aa(l, k) * work.a_acceleration[l];
    work.a_acceleration[k] = value * work.terms.M_aa(k, k);
  }
  accelerations_.segment(body.velocity + nu, m) = work.a_acceleration;

  Vector6d at_origin = at_M - work.outer_bias;
  if (body.outer.moves)
    for (Index l = 0; l < m; ++l) {
      at_origin.head<3>() -= work.a_acceleration[l] * work.outer.psi.col(l);
      at_origin.tail<3>() -= work.a_acceleration[l] * work.outer.jm.col(l);
    }
  work.frame.acceleration = carried(at_origin, -work.outer.s);
}

/// Accelerations of a body alone, without elimination; its S, which maps rates relative to the
/// world to its axes, is a rotation.
void TreeDynamics::accelerate_alone(const TreeBody& body, Work& work) {
  const auto extra = extra_forces_.segment<6>(body.velocity);
  Vector6d load = -work.terms.bias_r;
  load.head<3>() += work.R.transpose() * extra.head<3>();
  load.tail<3>() += extra.tail<3>();
  work.frame.acceleration = work.inverse.lazyProduct(load);
  auto u_rate = accelerations_.segment<6>(body.velocity);
  u_rate.head<3>() = work.R * work.frame.acceleration.head<3>() - world_.acceleration.head<3>();
  u_rate.tail<3>() = work.frame.acceleration.tail<3>();
}

void TreeDynamics::solve() {
  for (std::size_t b = work_.size(); b-- > 0;) {
    const TreeBody& body = tree_.bodies[b];
    if (body.is_alone) continue;
    eliminate_modes(body, work_[b]);
    eliminate_joint(body, work_[b]);
    pass_inwards(body, work_[b]);
  }
  for (std::size_t b = 0; b < work_.size(); ++b) {
    const TreeBody& body = tree_.bodies[b];
    if (body.is_alone)
      accelerate_alone(body, work_[b]);
    else
      accelerate(body, work_[b]);
  }
  ++evaluations_;
}

}  // namespace flexneck::multibody::tree
