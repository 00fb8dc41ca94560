// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/equations/force_set.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "multibody/numerics/rotation.h"

namespace flexneck::multibody {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Below this distance or angle a direction is not defined, and nothing acts.
constexpr double kSmallest = 1e-12;

}  // namespace

ForceSet::ForceSet(const Model& model) : model_(model) {
  for (const PointForce& force : model.forces) force_slots_.push_back(slot_of(force.marker));
  for (const Torque& torque : model.torques) torque_slots_.push_back(slot_of(torque.marker));
  for (const MarkerSpring& spring : model.springs)
    spring_pairs_.push_back(pair_of(spring.marker_i, spring.marker_j));
  for (const Bushing& bushing : model.bushings)
    bushing_pairs_.push_back(pair_of(bushing.marker_i, bushing.marker_j));
  for (const JointResistance& resistance : model.resistances) {
    const Joint& joint = model.joints[resistance.joint];
    resistance_pairs_.push_back(pair_of(joint.marker_i, joint.marker_j));
  }
  pieces_.assign(2 * (spring_pairs_.size() + resistance_pairs_.size()), 0);
}

void ForceSet::set_piece(std::size_t law, const LawPiece& piece) {
  pieces_[2 * law] = piece.deflection;
  pieces_[2 * law + 1] = piece.rate;
}

std::string ForceSet::name_of_piece(std::size_t index) const {
  const std::size_t law = index / 2;
  const std::size_t springs = model_.springs.size();
  const std::string who = law < springs
                              ? "spring '" + model_.springs[law].name + "'"
                              : "resistance '" + model_.resistances[law - springs].name + "'";
  return who + (index % 2 == 0 ? ": a stop or a kink of its curve"
                               : ": its friction or hysteresis turns over");
}

std::size_t ForceSet::slot_of(std::size_t marker) {
  const auto found = std::find(markers_.begin(), markers_.end(), marker);
  if (found != markers_.end()) return static_cast<std::size_t>(found - markers_.begin());
  const Body& body = model_.bodies[model_.markers[marker].body];
  markers_.push_back(marker);
  slots_.emplace_back();
  driven_.push_back(std::holds_alternative<DrivenBody>(body.kind));
  return markers_.size() - 1;
}

ForceSet::Pair ForceSet::pair_of(std::size_t marker_i, std::size_t marker_j) {
  const std::size_t i = slot_of(marker_i);
  return {i, slot_of(marker_j)};
}

void ForceSet::evaluate(double time_s) {
  stored_J_ = lost_W_ = work_W_ = potential_J_ = 0;
  for (ForceMarker& slot : slots_) {
    slot.force_N.setZero();
    slot.moment_Nm.setZero();
  }
  for (std::size_t k = 0; k < spring_pairs_.size(); ++k) apply_spring(k);
  for (std::size_t k = 0; k < bushing_pairs_.size(); ++k)
    apply(model_.bushings[k], bushing_pairs_[k]);
  for (std::size_t k = 0; k < resistance_pairs_.size(); ++k) apply_resistance(k);
  // So far only loads between markers: what they take from driven bodies is these bodies' work.
  for (std::size_t k = 0; k < slots_.size(); ++k)
    if (driven_[k])
      work_W_ -= slots_[k].force_N.dot(slots_[k].v) + slots_[k].moment_Nm.dot(slots_[k].w);
  for (std::size_t k = 0; k < force_slots_.size(); ++k) {
    ForceMarker& slot = slots_[force_slots_[k]];
    if (driven_[force_slots_[k]]) continue;
    const Vector3d force = model_.forces[k].magnitude_N.value(time_s) * model_.forces[k].direction;
    slot.force_N += force;
    work_W_ += force.dot(slot.v);
    potential_J_ -= force.dot(slot.p);
  }
  for (std::size_t k = 0; k < torque_slots_.size(); ++k) {
    ForceMarker& slot = slots_[torque_slots_[k]];
    if (driven_[torque_slots_[k]]) continue;
    const Vector3d torque =
        model_.torques[k].magnitude_Nm.value(time_s) * model_.torques[k].direction;
    slot.moment_Nm += torque;
    work_W_ += torque.dot(slot.w);
  }
}

void ForceSet::apply_pair(const Pair& pair, const Vector3d& force_on_j,
                          const Vector3d& moment_on_j) {
  ForceMarker& i = slots_[pair.i];
  ForceMarker& j = slots_[pair.j];
  j.force_N += force_on_j;
  j.moment_Nm += moment_on_j;
  // The opposite acts on i's body, at the same point.
  i.force_N -= force_on_j;
  i.moment_Nm -= moment_on_j + (j.p - i.p).cross(force_on_j);
}

void ForceSet::apply_spring(std::size_t index) {
  const MarkerSpring& spring = model_.springs[index];
  const Pair& pair = spring_pairs_[index];
  const ForceMarker& i = slots_[pair.i];
  const ForceMarker& j = slots_[pair.j];
  const Vector3d line = j.p - i.p;
  const double length = line.norm();
  if (!(length > kSmallest)) return;
  const Vector3d direction = line / length;
  const double deflection = length - spring.free_length_m;
  const double rate = direction.dot(j.v - i.v);
  const ResistanceLoad found = multibody::evaluate(spring.resistance, deflection, rate);
  set_piece(index, piece_of(spring.resistance, deflection, rate));
  stored_J_ += found.stored_J;
  lost_W_ += found.lost_W;
  apply_pair(pair, -found.load * direction, Vector3d::Zero());
}

void ForceSet::apply(const Bushing& bushing, const Pair& pair) {
  const ForceMarker& i = slots_[pair.i];
  const ForceMarker& j = slots_[pair.j];
  const Vector3d line = j.p - i.p;
  Vector6d e;
  e.head<3>() = i.R.transpose() * line;
  e.tail<3>() = rotation_log(i.R.transpose() * j.R);
  Vector6d rate;
  rate.head<3>() = i.R.transpose() * (j.v - i.v - i.w.cross(line));
  rate.tail<3>() = i.R.transpose() * (j.w - i.w);
  const Vector6d elastic = bushing.stiffness * e;
  const Vector6d viscous = bushing.damping * rate;
  stored_J_ += 0.5 * e.dot(elastic);
  lost_W_ += rate.dot(viscous);
  // The angular velocity is J_l theta', and moment . J_l theta' = elastic . theta'.
  const Matrix3d J = left_jacobian(e.tail<3>());
  const Vector3d moment = J.transpose().inverse() * elastic.tail<3>() + viscous.tail<3>();
  apply_pair(pair, -(i.R * (elastic.head<3>() + viscous.head<3>())), -(i.R * moment));
}

void ForceSet::apply_resistance(std::size_t index) {
  const JointResistance& resistance = model_.resistances[index];
  const Pair& pair = resistance_pairs_[index];
  const ForceMarker& i = slots_[pair.i];
  const ForceMarker& j = slots_[pair.j];
  const Joint& joint = model_.joints[resistance.joint];
  const Vector3d h = i.R * joint.axis;
  const auto load_at = [&](double x, double v) {
    const ResistanceLoad found = multibody::evaluate(resistance.resistance, x, v);
    stored_J_ += found.stored_J;
    lost_W_ += found.lost_W;
    set_piece(spring_pairs_.size() + index, piece_of(resistance.resistance, x, v));
    return found.load;
  };
  switch (resistance.coordinate) {
    case JointCoordinate::distance: {
      const Vector3d line = j.p - i.p;
      const double rate = h.dot(j.v - i.v - i.w.cross(line));
      apply_pair(pair, -load_at(h.dot(line), rate) * h, Vector3d::Zero());
      return;
    }
    case JointCoordinate::angle: {
      const Eigen::Quaterniond q(Matrix3d(i.R.transpose() * j.R));
      const double sign = q.w() < 0 ? -1 : 1;
      const double angle = 2 * std::atan2(sign * q.vec().dot(joint.axis), sign * q.w());
      apply_pair(pair, Vector3d::Zero(), -load_at(angle, h.dot(j.w - i.w)) * h);
      return;
    }
    case JointCoordinate::flexion:
      apply_flexion(index, h);
      return;
  }
}

void ForceSet::apply_flexion(std::size_t index, const Vector3d& h) {
  const JointResistance& flexion = model_.resistances[index];
  const Pair& pair = resistance_pairs_[index];
  const ForceMarker& i = slots_[pair.i];
  const ForceMarker& j = slots_[pair.j];
  const Resistance& resistance = flexion.resistance;
  const Vector3d h_j = j.R * model_.joints[flexion.joint].axis;
  const Vector3d rate = j.w - i.w;
  Vector3d moment = Vector3d::Zero();
  LawPiece piece;
  const auto record = [&](const ResistanceLoad& found, double sign) {
    stored_J_ += found.stored_J;
    lost_W_ += sign * found.lost_W;
    return sign * found.load;
  };
  // The curve bends back about the normal of both axes, which straight axes have not; there it
  // vanishes.
  const Vector3d across = h.cross(h_j);
  const double sine = across.norm();
  if (sine > kSmallest) {
    const Vector3d normal = across / sine;
    const double angle = std::atan2(sine, h.dot(h_j));
    const double bending = normal.dot(rate);
    moment -= record(multibody::evaluate(resistance, angle, bending), 1) * normal;
    moment -= record(multibody::evaluate(resistance, 0, bending), -1) * normal;
    piece = piece_of(resistance, angle, bending);
  }
  // Damping and friction, what is left without deflection, act against the whole rate across the
  // axis: about the normal alone they would jump where the axes are straight.
  const Vector3d swinging = rate - h.dot(rate) * h;
  const double speed = swinging.norm();
  if (speed > kSmallest)
    moment -= record(multibody::evaluate(resistance, 0, speed), 1) / speed * swinging;
  // Both rates count: bending turns over hysteresis, swinging friction.
  piece.rate += 3 * piece_of(resistance, 0, speed).rate;
  set_piece(spring_pairs_.size() + index, piece);
  apply_pair(pair, Vector3d::Zero(), moment);
}

void ForceSet::add_breakpoints(std::vector<double>& times_s) const {
  const auto add = [&](const TimeTable& table) {
    times_s.insert(times_s.end(), table.times_s().begin(), table.times_s().end());
  };
  for (const PointForce& force : model_.forces) add(force.magnitude_N);
  for (const Torque& torque : model_.torques) add(torque.magnitude_Nm);
}

}  // namespace flexneck::multibody
