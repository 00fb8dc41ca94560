// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/forces/joint_resistance.h"

#include <cmath>
#include <limits>

#include "multibody/joints/joint_kinds.h"

namespace flexneck::multibody {
namespace {

using Eigen::Vector3d;

/// Checks that the joint leaves the coordinate free.
void check_coordinate(const std::string& who, JointCoordinate of, const Joint& joint) {
  const auto demand = [&](JointCoordinate coordinate, bool JointKind::*has, const char* name) {
    if (of != coordinate || joint.kind->*has) return;
    std::string kinds;
    for (const JointKind* const kind : kJointKinds)
      if (kind->*has) kinds += (kinds.empty() ? "" : ", ") + std::string(kind->name);
    refuse_force(who, "joint '" + joint.name + "' is " + std::string(joint.kind->name) +
                          " and has no " + name + "; kinds that have one: " + kinds);
  };
  demand(JointCoordinate::distance, &JointKind::has_distance, "distance");
  demand(JointCoordinate::angle, &JointKind::has_angle, "angle");
}

void act_on_flexion(const Resistance& resistance, const Vector3d& axis, const ForceInput& input,
                    ForceLoad& load, ForceEnergies& sums) {
  const Vector3d h = input.i.R * axis;
  const Vector3d h_j = input.j.R * axis;
  const Vector3d rate = input.j.w - input.i.w;
  Vector3d moment = Vector3d::Zero();
  LawPiece piece;
  const auto record = [&](const ResistanceLoad& found, double sign) {
    sums.stored_J += found.stored_J;
    sums.lost_W += sign * found.lost_W;
    return sign * found.load;
  };
  // The curve's moment acts about the normal of both axes, which is undefined for straight axes;
  // the moment vanishes there.
  const Vector3d across = h.cross(h_j);
  const double sine = across.norm();
  if (sine > kNoDirection) {
    const Vector3d normal = across / sine;
    const double angle = std::atan2(sine, h.dot(h_j));
    const double bending = normal.dot(rate);
    moment -= record(evaluate(resistance, angle, bending), 1) * normal;
    moment -= record(evaluate(resistance, 0, bending), -1) * normal;
    piece = piece_of(resistance, angle, bending);
  }
  // Damping and friction, the load without deflection, act against the whole transverse rate: about
  // the normal alone they would jump where the axes are straight.
  const Vector3d swinging = rate - h.dot(rate) * h;
  const double speed = swinging.norm();
  if (speed > kNoDirection) moment -= record(evaluate(resistance, 0, speed), 1) / speed * swinging;
  // Both rates count: that of bending reverses hysteresis, that of swinging friction.
  const LawPiece swings = piece_of(resistance, 0, speed);
  piece.rate += 3 * swings.rate;
  // Neither the angle nor the speed, which are never negative, has a kink at zero; where the
  // bending rate has a kink, so has the speed.
  piece.of_rate = swings.of_rate;
  if (piece.of_deflection.low == 0)
    piece.of_deflection.low = -std::numeric_limits<double>::infinity();
  load.piece = piece;
  load.moment_Nm = moment;
}

}  // namespace

void JointResistance::check(const std::string& who, const ForceSites& sites) const {
  if (joint >= sites.joints.size())
    refuse_force(who, "there is no joint of index " + std::to_string(joint) + ": there are " +
                          std::to_string(sites.joints.size()));
  check_coordinate(who, coordinate, sites.joints[joint]);
  check_resistance(who, resistance);
}

void JointResistance::act(const ForceInput& input, ForceLoad& load, ForceEnergies& sums) const {
  const MarkerKinematics& i = input.i;
  const MarkerKinematics& j = input.j;
  const Vector3d& axis = input.joints[joint].axis;
  const Vector3d h = i.R * axis;
  const auto load_at = [&](double x, double v) {
    const ResistanceLoad found = evaluate(resistance, x, v);
    sums.stored_J += found.stored_J;
    sums.lost_W += found.lost_W;
    load.piece = piece_of(resistance, x, v);
    return found.load;
  };
  switch (coordinate) {
    case JointCoordinate::distance: {
      const Vector3d line = j.p - i.p;
      const double rate = h.dot(j.v - i.v - i.w.cross(line));
      load.force_N = -load_at(h.dot(line), rate) * h;
      return;
    }
    case JointCoordinate::angle: {
      const double rate = h.dot(j.w - i.w);
      const double within_turn = angle_about(axis, i.R.transpose() * j.R);
      const CountedAngle angle = input.angles[joint].at(input.time_s, within_turn, rate);
      load.moment_Nm = -load_at(angle.angle_rad, rate) * h;
      return;
    }
    case JointCoordinate::flexion:
      act_on_flexion(resistance, axis, input, load, sums);
      return;
  }
}

}  // namespace flexneck::multibody
