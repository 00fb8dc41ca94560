// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/descriptor/equations_of_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "multibody/numerics/rotation.h"

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr std::size_t kNone = JointPlace::kNoBody;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Index velocity_count_of(const System& system, std::size_t marker) {
  const std::size_t body = system.markers[marker].free_body;
  return body == kNone ? 0 : system.bodies[body].constants.velocity_count();
}

}  // namespace

EquationsOfMotion::EquationsOfMotion(const System& system, Drive drive)
    : system_(system),
      drive_(drive),
      interval_begin_s_(-kInfinity),
      interval_end_s_(kInfinity),
      prescribed_(system.prescribed.size()),
      forces_(system.model),
      solver_(system.body_sizes(), system.places, system.velocity_lengths_m()),
      right_hand_side_(VectorXd::Zero(system.velocity_count)),
      gamma_(VectorXd::Zero(system.constraint_count)),
      position_residual_(VectorXd::Zero(system.constraint_count)),
      velocity_residual_(VectorXd::Zero(system.constraint_count)),
      accelerations_(VectorXd::Zero(system.velocity_count)),
      multipliers_(VectorXd::Zero(system.constraint_count)),
      scratch_(VectorXd::Zero(system.constraint_count)),
      probe_(VectorXd::Zero(system.velocity_count)),
      lengths_m_(system.velocity_lengths_m()) {
  for (const FreeBody& body : system.bodies) bodies_.emplace_back(body.constants);
  std::vector<bool> active(system.markers.size(), false);
  for (const Joint& joint : system.joints) {
    active[joint.marker_i] = active[joint.marker_j] = true;
    joints_.emplace_back(joint, velocity_count_of(system, joint.marker_i),
                         velocity_count_of(system, joint.marker_j));
  }
  for (const std::size_t marker : forces_.markers()) active[marker] = true;
  for (std::size_t k = 0; k < system.markers.size(); ++k) {
    markers_.emplace_back(velocity_count_of(system, k));
    (active[k] ? active_markers_ : idle_markers_).push_back(k);
  }
}

void EquationsOfMotion::set_interval(double begin_s, double end_s) {
  interval_begin_s_ = std::nextafter(begin_s, kInfinity);
  interval_end_s_ = std::nextafter(end_s, -kInfinity);
}

double EquationsOfMotion::table_time(double time_s) const {
  return std::max(interval_begin_s_, std::min(interval_end_s_, time_s));
}

void EquationsOfMotion::update_prescribed_bodies() {
  for (std::size_t d = 0; d < system_.prescribed.size(); ++d) {
    const PrescribedMotion motion = system_.prescribed[d].at(time_s_, table_time(time_s_));
    if (drive_ == Drive::prescribed) {
      prescribed_[d] = motion;
    } else {
      prescribed_[d].position_m = motion.position_m;
      prescribed_[d].rotation = motion.rotation;
    }
  }
}

void EquationsOfMotion::follow_motor(CoordinateRow& row) const {
  if (row.motor == nullptr) return;
  const PrescribedCoordinate& path = row.motor->path;
  row.value = row.motor->start + path.value(time_s_);
  if (drive_ != Drive::prescribed) return;
  row.rate = path.rate(time_s_);
  row.second_rate = path.second_rate(table_time(time_s_));
}

void EquationsOfMotion::update_marker_configuration(std::size_t index) {
  const SystemMarker& marker = system_.markers[index];
  NodeKinematics& motion = markers_[index];
  if (marker.free_body != kNone) {
    update_configuration(marker.node, bodies_[marker.free_body], motion);
    return;
  }
  // Section 4, prescribed base: P and W stay empty.
  const PrescribedMotion& body = prescribed_[marker.prescribed_body];
  motion.p = body.position_m + body.rotation * marker.node.s0;
  motion.R = body.rotation * marker.node.R0;
}

void EquationsOfMotion::update_marker_velocities(std::size_t index, const ConstVector& velocities) {
  const SystemMarker& marker = system_.markers[index];
  NodeKinematics& motion = markers_[index];
  if (marker.free_body != kNone) {
    const FreeBody& body = system_.bodies[marker.free_body];
    update_velocities(marker.node, bodies_[marker.free_body],
                      velocities.segment(body.velocity, body.constants.velocity_count()), motion);
    return;
  }
  const PrescribedMotion& prescribed = prescribed_[marker.prescribed_body];
  const Vector3d arm = prescribed.rotation * marker.node.s0;
  const Vector3d& w = prescribed.angular_velocity_rad_s;
  motion.pd = prescribed.velocity_m_s + w.cross(arm);
  motion.gp = prescribed.acceleration_m_s2 + prescribed.angular_acceleration_rad_s2.cross(arm) +
              w.cross(w.cross(arm));
  motion.Om = w;
  motion.gr = prescribed.angular_acceleration_rad_s2;
}

void EquationsOfMotion::set_positions(double time_s, const ConstVector& positions) {
  update_positions(time_s, positions);
  factorise();
}

void EquationsOfMotion::factorise() {
  for (std::size_t b = 0; b < bodies_.size(); ++b) solver_.set_mass(b, bodies_[b].mass);
  for (std::size_t k = 0; k < joints_.size(); ++k) solver_.set_rows(k, joints_[k]);
  solver_.factorise();
}

void EquationsOfMotion::update_positions(double time_s, const ConstVector& positions) {
  time_s_ = time_s;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const FreeBody& body = system_.bodies[b];
    BodyTerms& terms = bodies_[b];
    const auto Q = positions.segment(body.position, 7 + body.constants.mode_count());
    terms.x = Q.head<3>();
    terms.A = Eigen::Quaterniond(Q[3], Q[4], Q[5], Q[6]).normalized().toRotationMatrix();
    terms.a = Q.tail(body.constants.mode_count());
    update_configuration(body.constants, terms);
  }
  update_prescribed_bodies();
  for (const std::size_t marker : active_markers_) update_marker_configuration(marker);
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    const Joint& joint = system_.joints[k];
    JointRows& rows = joints_[k];
    for (CoordinateRow& row : rows.coordinates) follow_motor(row);
    update_configuration(markers_[joint.marker_i], markers_[joint.marker_j], rows);
    position_residual_.segment(solver_.joint_offset(k), rows.rows) =
        rows.position_residual.head(rows.rows);
  }
}

void EquationsOfMotion::update_velocity_residual(const ConstVector& velocities) {
  for (const std::size_t marker : active_markers_) update_marker_velocities(marker, velocities);
  update_joint_velocities();
}

void EquationsOfMotion::update_joint_velocities() {
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    const Joint& joint = system_.joints[k];
    JointRows& rows = joints_[k];
    update_velocities(markers_[joint.marker_i], markers_[joint.marker_j], rows);
    const Index offset = solver_.joint_offset(k);
    velocity_residual_.segment(offset, rows.rows) = rows.velocity_residual.head(rows.rows);
    gamma_.segment(offset, rows.rows) = rows.gamma.head(rows.rows);
  }
}

void EquationsOfMotion::set_velocities(const ConstVector& velocities) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const FreeBody& body = system_.bodies[b];
    const Index size = body.constants.velocity_count();
    update_right_hand_side(body.constants, system_.gravity_m_s2,
                           velocities.segment(body.velocity, size), bodies_[b]);
    right_hand_side_.segment(body.velocity, size) = bodies_[b].u;
  }
  for (const std::size_t marker : active_markers_) update_marker_velocities(marker, velocities);
  apply_forces();
  update_joint_velocities();
}

void EquationsOfMotion::apply_forces() {
  const std::vector<std::size_t>& touched = forces_.markers();
  for (std::size_t k = 0; k < touched.size(); ++k) {
    const NodeKinematics& motion = markers_[touched[k]];
    ForceMarker& slot = forces_.slot(k);
    slot.p = motion.p;
    slot.v = motion.pd;
    slot.R = motion.R;
    slot.w = motion.Om;
  }
  forces_.evaluate(table_time(time_s_));
  for (std::size_t k = 0; k < touched.size(); ++k) {
    const std::size_t b = system_.markers[touched[k]].free_body;
    if (b == kNone) continue;
    // P^T F + W^T T are the terms of section 3: F, ~s A^T F + A^T T, psi^T A^T F + mu^T J_l^T A^T
    // T.
    const FreeBody& body = system_.bodies[b];
    const NodeKinematics& motion = markers_[touched[k]];
    auto load = right_hand_side_.segment(body.velocity, body.constants.velocity_count());
    load.noalias() += motion.P.transpose() * forces_.slot(k).force_N;
    load.noalias() += motion.W.transpose() * forces_.slot(k).moment_Nm;
  }
}

void EquationsOfMotion::solve() {
  accelerations_ = right_hand_side_;
  multipliers_ = gamma_;
  solver_.solve(accelerations_, multipliers_);
  ++evaluations_;
}

void EquationsOfMotion::evaluate(double time_s, const ConstVector& state, VectorXd& rate) {
  give_internal(state);
  set_positions(time_s, state.head(system_.position_count));
  set_velocities(state.segment(system_.position_count, system_.velocity_count));
  evaluate_updated(state, rate);
}

void EquationsOfMotion::evaluate_updated(const ConstVector& state, VectorXd& rate) {
  solve();
  fill_rate(state, accelerations_, rate);
}

void EquationsOfMotion::fill_rate(const ConstVector& state, const ConstVector& accelerations,
                                  VectorXd& rate) const {
  const Index nq = system_.position_count;
  const Index nv = system_.velocity_count;
  const auto velocities = state.segment(nq, nv);
  for (const FreeBody& body : system_.bodies) {
    const Index m = body.constants.mode_count();
    const auto V = velocities.segment(body.velocity, 6 + m);
    auto Q_rate = rate.segment(body.position, 7 + m);
    Q_rate.head<3>() = V.head<3>();
    Q_rate.segment<4>(3) = quaternion_rate(state.segment<4>(body.position + 3), V.segment<3>(3));
    Q_rate.tail(m) = V.tail(m);
  }
  rate.segment(nq, nv) = accelerations;
  system_.internal(rate) = forces_.internal_rate();
  rate.tail<2>() << dissipation_W(velocities), work_W();
}

void EquationsOfMotion::residual(double time_s, const ConstVector& state,
                                 const ConstVector& accelerations, const ConstVector& multipliers,
                                 VectorXd& residual) {
  const Index nv = system_.velocity_count;
  forces_.follow_step();
  update_positions(time_s, state.head(system_.position_count));
  set_velocities(state.segment(system_.position_count, nv));
  multipliers_ = multipliers;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const FreeBody& body = system_.bodies[b];
    const Index size = body.constants.velocity_count();
    auto part = residual.segment(body.velocity, size);
    part = -right_hand_side_.segment(body.velocity, size);
    part.noalias() += bodies_[b].mass * accelerations.segment(body.velocity, size);
  }
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    const JointRows& rows = joints_[k];
    const auto lambda = multipliers_.segment(solver_.joint_offset(k), rows.rows);
    const auto add = [&](std::size_t b, const TransposedRows& B_transposed) {
      if (b == kNone) return;
      residual.segment(system_.bodies[b].velocity, B_transposed.rows()).noalias() +=
          B_transposed.leftCols(rows.rows).lazyProduct(lambda);
    };
    add(system_.places[k].body_i, rows.B_i);
    add(system_.places[k].body_j, rows.B_j);
  }
  residual.tail(system_.constraint_count) = position_residual_;
  ++evaluations_;
}

void EquationsOfMotion::remove_residual(const VectorXd& residual, VectorXd& change) {
  change.setZero();
  scratch_ = -residual;
  solver_.solve(change, scratch_);
}

/// [M B^T; B 0] [V; .] = [M Z; 0] removes from velocities Z their constrained part: from numbers Z
/// without a pattern, zero remains where there is no freedom.
void EquationsOfMotion::given_velocities(std::vector<bool>& given) {
  constexpr double kNothing = 1e-6;
  const auto number = [](Index k) { return 1.5 + std::sin(1e3 * static_cast<double>(k + 1)); };
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const FreeBody& body = system_.bodies[b];
    auto load = probe_.segment(body.velocity, body.constants.velocity_count());
    load.setZero();
    for (Index k = 0; k < load.size(); ++k)
      load += number(body.velocity + k) / lengths_m_[body.velocity + k] * bodies_[b].mass.col(k);
  }
  scratch_.setZero();
  solver_.solve(probe_, scratch_);
  for (const FreeBody& body : system_.bodies) {
    const Index size = body.constants.velocity_count();
    const auto left = probe_.segment(body.velocity, size).array();
    const bool is_given =
        (left * lengths_m_.segment(body.velocity, size).array()).abs().maxCoeff() < kNothing;
    for (Index k = 0; k < size; ++k) given[static_cast<std::size_t>(body.velocity + k)] = is_given;
  }
}

void EquationsOfMotion::update_idle_markers(const ConstVector& velocities) {
  for (const std::size_t marker : idle_markers_) {
    update_marker_configuration(marker);
    update_marker_velocities(marker, velocities);
  }
}

Reaction EquationsOfMotion::joint_reaction(std::size_t joint) const {
  RowVector padded = RowVector::Zero();
  const Index rows = joints_[joint].rows;
  padded.head(rows) = multipliers_.segment(solver_.joint_offset(joint), rows);
  return reaction(joints_[joint], padded);
}

CountedAngle EquationsOfMotion::joint_angle(std::size_t index) const {
  const Joint& joint = system_.joints[index];
  const NodeKinematics& i = markers_[joint.marker_i];
  const NodeKinematics& j = markers_[joint.marker_j];
  const Vector3d h = i.R * joint.axis;
  CountedAngle seen = forces_.angle(index);
  if (!seen.is_seen && joint.kind->advances)
    seen.angle_rad = h.dot(j.p - i.p) * 2 * std::numbers::pi / joint.lead_m;
  return seen.at(time_s_, angle_about(joint.axis, i.R.transpose() * j.R), h.dot(j.Om - i.Om));
}

void EquationsOfMotion::count_turns() {
  for (std::size_t k = 0; k < system_.joints.size(); ++k)
    if (system_.joints[k].kind->has_angle) forces_.angle(k) = joint_angle(k);
}

void EquationsOfMotion::take_turns(const EquationsOfMotion& other) {
  for (std::size_t k = 0; k < system_.joints.size(); ++k) forces_.angle(k) = other.forces_.angle(k);
}

double EquationsOfMotion::dissipation_W(const ConstVector& velocities) const {
  double power = forces_.lost_W();
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const FreeBody& body = system_.bodies[b];
    const Index m = body.constants.mode_count();
    power += body.constants.springs.lost_W(bodies_[b].a, velocities.segment(body.velocity + 6, m));
  }
  return power;
}

double EquationsOfMotion::work_W() const {
  double power = forces_.work_W();
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    const JointRows& joint = joints_[k];
    for (std::size_t c = 0; c < joint.coordinates.size(); ++c)
      power +=
          joint.coordinates[c].rate *
          multipliers_[solver_.joint_offset(k) + joint.first_coordinate() + static_cast<Index>(c)];
  }
  // Adds the power of the prescribed bodies at the origin of marker j, where the reaction acts: -f
  // on body i, +f on body j.
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    if (system_.places[k].body_i != kNone && system_.places[k].body_j != kNone) continue;
    const NodeKinematics& i = markers_[system_.joints[k].marker_i];
    const NodeKinematics& j = markers_[system_.joints[k].marker_j];
    const Reaction on_j = joint_reaction(k);
    if (system_.places[k].body_i == kNone)
      power += on_j.force_N.dot(i.pd + i.Om.cross(j.p - i.p)) + on_j.moment_Nm.dot(i.Om);
    if (system_.places[k].body_j == kNone)
      power -= on_j.force_N.dot(j.pd) + on_j.moment_Nm.dot(j.Om);
  }
  return power;
}

}  // namespace flexneck::multibody
