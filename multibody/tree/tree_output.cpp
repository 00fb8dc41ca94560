// SPDX-License-Identifier: GPL-3.0-or-later
// Output of a tree once its equations are solved.
#include <algorithm>

#include "multibody/tree/spatial.h"
#include "multibody/tree/tree_dynamics.h"

namespace flexneck::multibody::tree {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector6d TreeDynamics::Work::reaction() const {
  Vector6d load = terms.bias_r;
  load.noalias() += terms.M_rr * frame.acceleration;
  for (Index l = 0; l < a.size(); ++l) load += a_acceleration[l] * terms.M_ra.col(l);
  return shifted(load, Vector3d(-outer.s));
}

BodyState TreeDynamics::body_state(std::size_t body) const {
  const Work& work = work_[body];
  const Frame& frame = work.frame;
  const Index m = work.a.size();
  BodyState state{frame.x, frame.A, work.a, Eigen::VectorXd(6 + m), Eigen::VectorXd(6 + m)};
  state.velocities << frame.A * frame.v, frame.w, work.a_rate;
  state.accelerations << frame.A * frame.acceleration.head<3>() + gravity_,
      frame.acceleration.tail<3>(), work.a_acceleration;
  return state;
}

void TreeDynamics::marker_state(std::size_t index, MarkerState& state) {
  const TreeMarker& marker = tree_.markers[index];
  NodeMotion& node = marker_nodes_[index];
  const Frame& frame = frame_of(marker.carrier);
  const bool moves = marker.node.moves;
  if (moves) {
    const Work& work = work_[marker.carrier.body];
    tree::update(marker.node, work.a, work.a_rate, node);
  }
  const Vector3d carried_along = frame.w.cross(node.s);
  Vector3d velocity = frame.v + carried_along;
  Vector3d w = frame.w;
  Vector3d acceleration = frame.acceleration.head<3>() +
                          frame.acceleration.tail<3>().cross(node.s) + frame.w.cross(carried_along);
  Vector3d turning = frame.acceleration.tail<3>();
  if (moves) {
    const Work& work = work_[marker.carrier.body];
    velocity += node.s_dot;
    w += node.turn;
    acceleration += 2 * frame.w.cross(node.s_dot) + node.s_dot_rate;
    turning += frame.w.cross(node.turn) + node.turn_rate;
    for (Index l = 0; l < work.a.size(); ++l) {
      acceleration += work.a_acceleration[l] * node.psi.col(l);
      turning += work.a_acceleration[l] * node.jm.col(l);
    }
  }
  state.position_m = frame.x + frame.A * node.s;
  state.rotation = frame.A * node.R;
  state.velocity_m_s = frame.A * velocity;
  state.angular_velocity_rad_s = frame.A * w;
  state.acceleration_m_s2 = frame.A * acceleration + gravity_;
  state.angular_acceleration_rad_s2 = frame.A * turning;
}

Reaction TreeDynamics::joint_reaction(std::size_t joint) const {
  const std::size_t b = tree_.body_of_joint[joint];
  if (b == kNone) return {Vector3d::Zero(), Vector3d::Zero()};
  const Work& work = work_[b];
  const Vector6d reaction = work.reaction();
  const Vector3d force = work.frame.A * reaction.head<3>();
  const Vector3d moment = work.frame.A * reaction.tail<3>();
  if (tree_.bodies[b].inner_is_i) return {force, moment};
  // Marker j is the inner one: the load at M acts on i, and is referred to F.
  const Vector3d arm = frame_of(tree_.bodies[b].carrier).A * work.d;
  return {-force, -(moment + arm.cross(force))};
}

Matrix3d TreeDynamics::joint_axes(std::size_t joint) const {
  const std::size_t b = tree_.body_of_joint[joint];
  if (b == kNone) return Matrix3d::Identity();
  const Work& work = work_[b];
  return tree_.bodies[b].inner_is_i ? frame_of(tree_.bodies[b].carrier).A * work.inner.R
                                    : work.frame.A * work.outer.R;
}

Energies TreeDynamics::energies() const {
  Energies sum;
  sum.strain_J = forces_.stored_J();
  for (std::size_t b = 0; b < work_.size(); ++b) {
    const BodyInertia& body = tree_.bodies[b].inertia;
    const Work& work = work_[b];
    const Frame& frame = work.frame;
    Vector3d S = body.S1;
    for (Index l = 0; l < work.a.size(); ++l) S += work.a[l] * body.S2.col(l);
    if (body.stiffens()) S += 0.5 * contracted(body.slopes.S2, work.a, work.a);
    sum.strain_J += body.springs.energy_J(work.a);
    sum.kinetic_J += kinetic_energy_J(body, work.a, work.a_rate, frame.v, frame.w);
    sum.gravitational_J -= gravity_.dot(body.mass * frame.x + frame.A * S);
  }
  for (const Frame& base : prescribed_) {
    double carried_J = 0;
    for (std::size_t b = 0; b < work_.size(); ++b) {
      const BodyInertia& body = tree_.bodies[b].inertia;
      const Vector3d v = base.v + base.w.cross(work_[b].frame.x - base.x);
      carried_J += carried_energy_J(v, base.w, body.mass, body.J0.head<3>().sum());
    }
    sum.carried_J = std::max(sum.carried_J, carried_J);
  }
  return sum;
}

double TreeDynamics::dissipation_W() const {
  double power = forces_.lost_W();
  for (std::size_t b = 0; b < work_.size(); ++b)
    power += tree_.bodies[b].inertia.springs.lost_W(work_[b].a, work_[b].a_rate);
  return power;
}

double TreeDynamics::work_W() const {
  double power = forces_.work_W();
  // Adds the power of the prescribed body's point at M on the body that it carries.
  for (std::size_t b = 0; b < work_.size(); ++b) {
    const Carrier& carrier = tree_.bodies[b].carrier;
    if (carrier.prescribed == kNone) continue;
    const Frame& prescribed = prescribed_[carrier.prescribed];
    const Work& work = work_[b];
    const Vector6d reaction = work.reaction();
    const Vector3d velocity = prescribed.v + prescribed.w.cross(work.inner.s + work.d);
    // R maps this body's axes to the prescribed one's.
    power += (work.R * reaction.head<3>()).dot(velocity) +
             (work.R * reaction.tail<3>()).dot(prescribed.w);
  }
  return power;
}

}  // namespace flexneck::multibody::tree
