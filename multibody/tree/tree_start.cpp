// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/tree/tree_start.h"

#include <algorithm>

#include <Eigen/Cholesky>

#include "multibody/descriptor/initial_state.h"
#include "multibody/model/joint_check.h"
#include "multibody/numerics/rotation.h"

namespace flexneck::multibody::tree {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Position and velocity of a frame, world axes.
struct FrameState {
  Vector3d x = Vector3d::Zero();
  Matrix3d R = Matrix3d::Identity();
  Vector3d v = Vector3d::Zero();
  Vector3d w = Vector3d::Zero();
};

FrameState node_state(const TreeNode& node, const BodyState& body) {
  const Index m = body.modal.size();
  NodeMotion motion(node);
  update(node, body.modal, body.velocities.tail(m), motion);
  const Vector3d w = body.velocities.segment<3>(3);
  return {body.position_m + body.rotation * motion.s, body.rotation * motion.R,
          body.velocities.head<3>() + body.rotation * (w.cross(motion.s) + motion.s_dot),
          body.rotation * (w + motion.turn)};
}

FrameState prescribed_state(const PrescribedPath& path, double time_s, const TreeNode& node) {
  const PrescribedMotion body = path.at(time_s);
  const Vector3d arm = body.rotation * node.s0;
  return {body.position_m + arm, body.rotation * node.R0,
          body.velocity_m_s + body.angular_velocity_rad_s.cross(arm), body.angular_velocity_rad_s};
}

/// Puts the angle of a joint that has one into the turn in which it starts.
void start_in_turn(const Tree& tree, const TreeBody& body, VectorXd& q) {
  if (body.joint_index == kNone) return;
  const Joint& joint = tree.model.joints[body.joint_index];
  if (!joint.kind->has_angle || joint.kind->advances) return;
  const double start = body.inner_is_i ? joint.start_angle_rad : -joint.start_angle_rad;
  q.tail<1>()[0] = CountedAngle{.angle_rad = start}.at(0, q.tail<1>()[0], 0).angle_rad;
}

/// A joint's coordinates and rates, and the residuals of its markers' relative motion.
struct Fit {
  VectorXd q, u;
  Violation position, velocity;
};

Fit fit(const TreeJoint& joint, const FrameState& inner, const FrameState& outer) {
  const Matrix3d R = inner.R.transpose() * outer.R;
  const Vector3d d = inner.R.transpose() * (outer.x - inner.x);
  Fit result;
  result.q = nearest_coordinates(joint, R, d);
  const Index nu = joint.velocity_count();
  result.u = VectorXd::Zero(nu);
  JointMotion motion;
  update(joint, result.q, result.u, motion);
  result.position = {(d - motion.d).norm(), rotation_log(motion.R.transpose() * R).norm()};
  Vector6d relative;
  relative << outer.v - inner.v - inner.w.cross(outer.x - inner.x), outer.w - inner.w;
  relative.head<3>() = outer.R.transpose() * relative.head<3>();
  relative.tail<3>() = outer.R.transpose() * relative.tail<3>();
  if (nu > 0) {
    const Matrix6Xd S = motion.S.leftCols(nu);
    result.u = (S.transpose() * S).ldlt().solve(S.transpose() * relative);
    relative -= S * result.u;
  }
  result.velocity = {relative.head<3>().norm(), relative.tail<3>().norm()};
  return result;
}

struct Fits {
  VectorXd state;
  std::vector<Fit> joints;  ///< by the tree's bodies
  double speed_m_s = 0;     ///< largest speed of a marker
};

Fits fit_all(const Tree& tree, const std::vector<BodyState>& bodies) {
  Fits result;
  result.state = VectorXd::Zero(tree.state_count());
  for (std::size_t b = 0; b < tree.bodies.size(); ++b) {
    const TreeBody& body = tree.bodies[b];
    FrameState inner;
    if (body.carrier.body != kNone) inner = node_state(body.inner, bodies[body.carrier.body]);
    if (body.carrier.prescribed != kNone)
      inner = prescribed_state(tree.prescribed[body.carrier.prescribed], tree.model.start.time_s,
                               body.inner);
    const FrameState outer = node_state(body.outer, bodies[b]);
    Fit found = fit(body.joint, inner, outer);
    start_in_turn(tree, body, found.q);
    for (const FrameState& each : {inner, outer})
      result.speed_m_s = std::max({result.speed_m_s, each.v.norm(), tree.size_m * each.w.norm()});
    const Index m = body.inertia.mode_count();
    const Index velocity = tree.position_count + body.velocity;
    result.state.segment(body.position, found.q.size()) = found.q;
    result.state.segment(body.position + found.q.size(), m) = bodies[b].modal;
    result.state.segment(velocity, found.u.size()) = found.u;
    result.state.segment(velocity + found.u.size(), m) = bodies[b].velocities.tail(m);
    result.joints.push_back(found);
  }
  return result;
}

std::vector<BodyState> given_bodies(const Tree& tree) {
  std::vector<BodyState> bodies;
  for (const TreeBody& each : tree.bodies) {
    const Body& body = tree.model.bodies[each.index];
    const Index m = each.inertia.mode_count();
    BodyState state{body.initial_pose.position_m,
                    body.initial_pose.rotation.normalized().toRotationMatrix(), VectorXd::Zero(m),
                    VectorXd::Zero(6 + m), VectorXd::Zero(6 + m)};
    if (const auto* const deformable = std::get_if<DeformableBody>(&body.kind)) {
      state.modal = initial_modal(*deformable);
      state.velocities.tail(m) = initial_modal_rate(*deformable);
    }
    state.velocities.head<3>() = body.initial_velocity_m_s;
    state.velocities.segment<3>(3) = body.initial_angular_velocity_rad_s;
    bodies.push_back(std::move(state));
  }
  return bodies;
}

bool any_velocity_is_open(const Tree& tree) {
  const std::vector<Body>& bodies = tree.model.bodies;
  return std::any_of(bodies.begin(), bodies.end(),
                     [](const Body& body) { return body.velocities_are_open; });
}

bool velocities_fit(const Tree& tree, const Fits& found) {
  return std::all_of(found.joints.begin(), found.joints.end(), [&](const Fit& joint) {
    return multibody::velocities_fit(joint.velocity, tree.size_m, found.speed_m_s);
  });
}

void check_joints(const Tree& tree, const Fits& found, bool with_velocities) {
  for (std::size_t k = 0; k < tree.body_of_joint.size(); ++k) {
    const std::size_t b = tree.body_of_joint[k];
    if (b == kNone) continue;
    check_positions(tree.model, k, found.joints[b].position, tree.size_m);
  }
  if (!with_velocities) return;
  for (std::size_t k = 0; k < tree.body_of_joint.size(); ++k) {
    const std::size_t b = tree.body_of_joint[k];
    if (b == kNone) continue;
    check_velocities(tree.model, k, found.joints[b].velocity, tree.size_m, found.speed_m_s);
  }
}

}  // namespace

VectorXd given_state(const Tree& tree) {
  std::vector<BodyState> bodies = given_bodies(tree);
  Fits found = fit_all(tree, bodies);
  if (any_velocity_is_open(tree) && !velocities_fit(tree, found)) {
    const std::vector<VectorXd> velocities = fitting_velocities(tree.model);
    for (std::size_t b = 0; b < bodies.size(); ++b)
      bodies[b].velocities = velocities[tree.bodies[b].index];
    found = fit_all(tree, bodies);
  }
  check_joints(tree, found, true);
  return found.state;
}

VectorXd given_positions(const Tree& tree) {
  Fits found = fit_all(tree, given_bodies(tree));
  check_joints(tree, found, false);
  found.state.tail(found.state.size() - tree.position_count).setZero();
  return found.state;
}

VectorXd state_of(const Tree& tree, const std::vector<BodyState>& bodies) {
  return fit_all(tree, bodies).state;
}

}  // namespace flexneck::multibody::tree
