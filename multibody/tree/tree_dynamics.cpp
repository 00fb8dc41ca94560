// SPDX-License-Identifier: GPL-3.0-or-later
// Motion and loads of a tree's bodies at a given state, in an outward pass.
#include "multibody/tree/tree_dynamics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

#include "multibody/tree/spatial.h"

namespace flexneck::multibody::tree {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

TreeDynamics::Work::Work(const TreeBody& body)
    : a(VectorXd::Zero(body.inertia.mode_count())),
      a_rate(a),
      a_acceleration(a),
      inner(body.inner),
      outer(body.outer),
      R(inner.R * outer.R.transpose()),
      d(Vector3d::Zero()),
      S(Matrix6d::Zero()),
      terms(body.inertia),
      coupling(6, body.inertia.mode_count()),
      z(a),
      U(Matrix6d::Zero()),
      D(Matrix6d::Zero()) {
  // These are constant for a rigid end; for other bodies each state sets them anew.
  tree::update(body.inertia, a, a_rate, Vector3d::Zero(), terms);
  inertia = shifted(terms.M_rr, Vector3d(-outer.s));
  if (body.is_alone) inverse = inertia.llt().solve(Matrix6d::Identity());
}

TreeDynamics::TreeDynamics(const Tree& tree, Drive drive)
    : tree_(tree),
      drive_(drive),
      gravity_(tree.model.gravity_m_s2),
      interval_begin_s_(-kInfinity),
      interval_end_s_(kInfinity),
      prescribed_(tree.prescribed.size()),
      forces_(tree.model),
      extra_forces_(VectorXd::Zero(tree.velocity_count)),
      accelerations_(VectorXd::Zero(tree.velocity_count)) {
  world_.acceleration.head<3>() = -gravity_;
  work_.reserve(tree.bodies.size());
  for (const TreeBody& body : tree.bodies) work_.emplace_back(body);
  for (const TreeMarker& marker : tree.markers) marker_nodes_.emplace_back(marker.node);
}

void TreeDynamics::set_interval(double begin_s, double end_s) {
  interval_begin_s_ = std::nextafter(begin_s, kInfinity);
  interval_end_s_ = std::nextafter(end_s, -kInfinity);
}

double TreeDynamics::table_time(double time_s) const {
  return std::max(interval_begin_s_, std::min(interval_end_s_, time_s));
}

const TreeDynamics::Frame& TreeDynamics::frame_of(const Carrier& carrier) const {
  if (carrier.body != kNone) return work_[carrier.body].frame;
  return carrier.prescribed != kNone ? prescribed_[carrier.prescribed] : world_;
}

void TreeDynamics::update_prescribed_bodies() {
  for (std::size_t d = 0; d < prescribed_.size(); ++d) {
    const PrescribedMotion motion = tree_.prescribed[d].at(time_s_, table_time(time_s_));
    Frame& frame = prescribed_[d];
    frame.x = motion.position_m;
    frame.A = motion.rotation;
    Vector3d acceleration = -gravity_;
    if (drive_ == Drive::prescribed) {
      frame.v = frame.A.transpose() * motion.velocity_m_s;
      frame.w = frame.A.transpose() * motion.angular_velocity_rad_s;
      acceleration += motion.acceleration_m_s2;
      frame.acceleration.tail<3>() = frame.A.transpose() * motion.angular_acceleration_rad_s2;
    }
    frame.acceleration.head<3>() = frame.A.transpose() * acceleration;
  }
}

void TreeDynamics::update_body(const TreeBody& body, Work& work, const ConstVector& state,
                               Purpose purpose) {
  const Index m = body.inertia.mode_count();
  const Index nq = body.joint.position_count();
  const Index nu = body.joint.velocity_count();
  const auto q = state.segment(body.position, nq);
  const auto u = state.segment(tree_.position_count + body.velocity, nu);
  work.a = state.segment(body.position + nq, m);
  work.a_rate = state.segment(tree_.position_count + body.velocity + nu, m);
  const Frame& carrier = frame_of(body.carrier);
  if (body.carrier.body != kNone) {
    const Work& inner = work_[body.carrier.body];
    tree::update(body.inner, inner.a, inner.a_rate, work.inner);
  }
  tree::update(body.outer, work.a, work.a_rate, work.outer);

  // Orientation and position. For a fixed joint d and its bias are zero.
  const JointMotion& joint = work.joint;
  if (!body.is_fixed()) {
    tree::update(body.joint, q, u, work.joint);
    work.R.noalias() = (work.inner.R * joint.R) * work.outer.R.transpose();
    work.d.noalias() = work.inner.R * joint.d;
  } else if (body.inner.moves || body.outer.moves) {
    work.R.noalias() = work.inner.R * work.outer.R.transpose();
  }
  Frame& frame = work.frame;
  frame.A.noalias() = carrier.A * work.R;
  frame.x = carrier.x + carrier.A * (work.inner.s + work.d) - frame.A * work.outer.s;

  // Velocities of F in the carrier's axes, of M and of the body in the body's.
  const Vector3d w_F = carrier.w + work.inner.turn;
  const Vector3d v_F = carrier.v + carrier.w.cross(work.inner.s) + work.inner.s_dot;
  Vector6d relative = Vector6d::Zero();
  for (Index k = 0; k < nu; ++k) {
    work.S.block<3, 1>(0, k).noalias() = work.outer.R * joint.S.block<3, 1>(0, k);
    work.S.block<3, 1>(3, k).noalias() = work.outer.R * joint.S.block<3, 1>(3, k);
    relative += u[k] * work.S.col(k);
  }
  const Vector3d w_carried = work.R.transpose() * w_F;
  const Vector3d w_M = w_carried + relative.tail<3>();
  const Vector3d v_M = work.R.transpose() * (v_F + w_F.cross(work.d)) + relative.head<3>();
  frame.w = w_M - work.outer.turn;
  frame.v = v_M - frame.w.cross(work.outer.s) - work.outer.s_dot;

  work.inner_bias = node_bias(work.inner, carrier.w);
  work.outer_bias = node_bias(work.outer, frame.w);
  if (!body.is_fixed()) {
    work.joint_bias.head<3>() =
        work.R.transpose() * w_F.cross(w_F.cross(work.d)) + 2 * w_carried.cross(relative.head<3>());
    work.joint_bias.tail<3>() = w_carried.cross(relative.tail<3>()) + work.outer.R * joint.S_dot_u;
  }
  if (body.is_rigid_end)
    update_rigid_bias(body.inertia, frame.w, work.terms);
  else if (body.rides && purpose == Purpose::motion)
    update_modes(body.inertia, work.a, work.a_rate, work.terms);
  else
    tree::update(body.inertia, work.a, work.a_rate, frame.w, work.terms);
}

/// Updates a body whose markers F and M are the world and its own axes.
void TreeDynamics::update_alone(const TreeBody& body, Work& work, const ConstVector& state) {
  const auto u = state.segment<6>(tree_.position_count + body.velocity);
  tree::update(body.joint, state.segment<7>(body.position), u, work.joint);
  work.R = work.joint.R;
  work.d = work.joint.d;
  work.frame.A = work.R;
  work.frame.x = work.d;
  work.frame.v.noalias() = work.R.transpose() * u.head<3>();
  work.frame.w = u.tail<3>();
  update_rigid_bias(body.inertia, work.frame.w, work.terms);
}

void TreeDynamics::update(double time_s, const ConstVector& state, Purpose purpose) {
  time_s_ = time_s;
  update_prescribed_bodies();
  for (std::size_t b = 0; b < work_.size(); ++b) {
    const TreeBody& body = tree_.bodies[b];
    if (body.is_alone)
      update_alone(body, work_[b], state);
    else
      update_body(body, work_[b], state, purpose);
  }
  for (const std::size_t joint : forces_.turned_joints())
    forces_.angle(joint).angle_rad = joint_angle_rad(tree_, joint, state);
  apply_forces();
}

void TreeDynamics::apply_forces() {
  const std::vector<std::size_t>& touched = forces_.markers();
  for (std::size_t k = 0; k < touched.size(); ++k) {
    const TreeMarker& marker = tree_.markers[touched[k]];
    NodeMotion& node = marker_nodes_[touched[k]];
    if (marker.carrier.body != kNone) {
      const Work& work = work_[marker.carrier.body];
      tree::update(marker.node, work.a, work.a_rate, node);
    }
    const Frame& frame = frame_of(marker.carrier);
    ForceMarker& slot = forces_.slot(k);
    slot.p = frame.x + frame.A * node.s;
    slot.v = frame.A * (frame.v + frame.w.cross(node.s) + node.s_dot);
    slot.R = frame.A * node.R;
    slot.w = frame.A * (frame.w + node.turn);
  }
  forces_.evaluate(table_time(time_s_));
  for (std::size_t k = 0; k < touched.size(); ++k)
    apply(tree_.markers[touched[k]], marker_nodes_[touched[k]], forces_.slot(k).force_N,
          forces_.slot(k).moment_Nm);
}

void TreeDynamics::apply(const TreeMarker& marker, const NodeMotion& node, const Vector3d& force,
                         const Vector3d& torque) {
  if (marker.carrier.body == kNone) return;
  Work& work = work_[marker.carrier.body];
  const Vector3d f = work.frame.A.transpose() * force;
  const Vector3d t = work.frame.A.transpose() * torque;
  work.terms.bias_r.head<3>() -= f;
  work.terms.bias_r.tail<3>() -= node.s.cross(f) + t;
  if (!marker.node.moves) return;
  for (Index l = 0; l < work.a.size(); ++l)
    work.terms.bias_a[l] -= node.psi.col(l).dot(f) + node.jm.col(l).dot(t);
}

void TreeDynamics::evaluate(double time_s, const ConstVector& state, VectorXd& rate) {
  give_internal(state);
  update(time_s, state, Purpose::motion);
  solve();
  fill_rate(state, accelerations_, rate);
}

void TreeDynamics::fill_rate(const ConstVector& state, const ConstVector& accelerations,
                             VectorXd& rate) const {
  const Index nq = tree_.position_count;
  const Index nv = tree_.velocity_count;
  for (const TreeBody& body : tree_.bodies) {
    const Index q = body.joint.position_count();
    const Index u = body.joint.velocity_count();
    const Index m = body.inertia.mode_count();
    position_rate(body.joint, state.segment(body.position, q), state.segment(nq + body.velocity, u),
                  rate.segment(body.position, q));
    rate.segment(body.position + q, m) = state.segment(nq + body.velocity + u, m);
  }
  rate.segment(nq, nv) = accelerations;
  tree_.internal(rate) = forces_.internal_rate();
  rate.tail<2>() << dissipation_W(), work_W();
}

}  // namespace flexneck::multibody::tree
