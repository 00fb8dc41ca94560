// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/model/start_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "multibody/numerics/rotation.h"

namespace flexneck::pipeline {

using Eigen::Vector3d;
using multibody::Body;
using multibody::Joint;
using multibody::Marker;
using multibody::Model;
using multibody::Pose;
using multibody::PrescribedBody;

namespace {

constexpr double kRounding = 1e-6;

bool differ(double a, double b) {
  return !(std::abs(a - b) <= kRounding * std::max({1.0, std::abs(a), std::abs(b)}));
}

std::string text(const Vector3d& v) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", v[0], v[1], v[2]);
}

/// Pose and velocity of j relative to i, along and about the joint's axis.
JointStart found_start(const Model& model, const Joint& joint) {
  const Marker& marker_i = model.markers[joint.marker_i];
  const Marker& marker_j = model.markers[joint.marker_j];
  const Body& body_i = model.bodies[marker_i.body];
  const Body& body_j = model.bodies[marker_j.body];
  const Pose at_i = pose_of(body_i) * marker_pose(model, marker_i);
  const Pose at_j = pose_of(body_j) * marker_pose(model, marker_j);
  const Pose step = inverse(at_i) * at_j;
  const BodyMotion i = motion_of(body_i);
  const BodyMotion j = motion_of(body_j);
  const Vector3d axis = at_i.rotation * joint.axis;
  const auto velocity = [&](const Body& body, const BodyMotion& motion) {
    return Vector3d(motion.v + motion.w.cross(at_j.position_m - pose_of(body).position_m));
  };
  return {step.position_m.dot(joint.axis),
          2 * std::atan2(step.rotation.vec().dot(joint.axis), step.rotation.w()),
          (velocity(body_j, j) - velocity(body_i, i)).dot(axis), (j.w - i.w).dot(axis)};
}

/// Text naming the source of the joint's pose: the keys of one of its bodies with their values.
std::string pose_keys(const Assembly& assembly, const Joint& joint) {
  for (const std::size_t marker : {joint.marker_j, joint.marker_i}) {
    const std::size_t b = assembly.model.markers[marker].body;
    const Body& body = assembly.model.bodies[b];
    if (!assembly.posed[b] || std::holds_alternative<PrescribedBody>(body.kind)) continue;
    const Vector3d turn = multibody::rotation_log(body.initial_pose.rotation.toRotationMatrix());
    return "body '" + body.name + "' with position = " + text(body.initial_pose.position_m) +
           " m and rotation = " + text(turn) + " rad";
  }
  return "the position of its bodies, which follows from other joints";
}

std::string velocity_keys(const Assembly& assembly, const Joint& joint) {
  for (const std::size_t marker : {joint.marker_j, joint.marker_i}) {
    const std::size_t b = assembly.model.markers[marker].body;
    const Body& body = assembly.model.bodies[b];
    if (!assembly.moving[b]) continue;
    return "body '" + body.name + "' with velocity = " + text(body.initial_velocity_m_s) +
           " m/s and angular_velocity = " + text(body.initial_angular_velocity_rad_s) + " rad/s";
  }
  return "the velocity of its bodies, which follows from other joints";
}

[[noreturn]] void refuse(const Joint& joint, const std::string& key, double given,
                         const std::string& unit, const std::string& other, double found) {
  throw InputError(
      fmt::format("joint '{}': {} = {:.6g} {} contradicts {}, from which it is {:.6g} {}; remove "
                  "one of them, or make them agree",
                  joint.name, key, given, unit, other, found, unit));
}

void check_joint(const Assembly& assembly, std::size_t index) {
  const Joint& joint = assembly.model.joints[index];
  const JointStart& given = assembly.starts[index];
  const JointStart found = found_start(assembly.model, joint);
  if (given.distance_m && differ(*given.distance_m, *found.distance_m))
    refuse(joint, "distance", *given.distance_m, "m", pose_keys(assembly, joint),
           *found.distance_m);
  if (given.angle_rad) {
    const double off = std::remainder(*found.angle_rad - *given.angle_rad, 2 * std::numbers::pi);
    if (differ(off, 0))
      refuse(joint, "angle", *given.angle_rad, "rad", pose_keys(assembly, joint),
             *given.angle_rad + off);
  }
  // Rates of motors are checked with those of all joints.
  if (!joint.motors.empty()) return;
  if (given.speed_m_s && differ(*given.speed_m_s, *found.speed_m_s))
    refuse(joint, "speed", *given.speed_m_s, "m/s", velocity_keys(assembly, joint),
           *found.speed_m_s);
  if (given.rate_rad_s && differ(*given.rate_rad_s, *found.rate_rad_s))
    refuse(joint, "rate", *given.rate_rad_s, "rad/s", velocity_keys(assembly, joint),
           *found.rate_rad_s);
}

/// Fails if initial values contradict a start at rest.
/// @param rest  the key that asks for it
void check_rest(const Assembly& assembly, const std::string& rest) {
  const std::string but =
      ", but " + rest +
      ", in which no body moves relative to the prescribed bodies; remove one of them";
  for (std::size_t k = 0; k < assembly.starts.size(); ++k) {
    const std::string joint = "joint '" + assembly.model.joints[k].name + "': ";
    const JointStart& start = assembly.starts[k];
    if (start.rate_rad_s.value_or(0) != 0)
      throw InputError(joint + fmt::format("rate = {:.6g} rad/s", *start.rate_rad_s) + but);
    if (start.speed_m_s.value_or(0) != 0)
      throw InputError(joint + fmt::format("speed = {:.6g} m/s", *start.speed_m_s) + but);
  }
  for (const Body& body : assembly.model.bodies) {
    const auto* const deformable = std::get_if<multibody::DeformableBody>(&body.kind);
    if (deformable == nullptr) continue;
    if (deformable->initial_modal.size() > 0)
      throw InputError("body '" + body.name + "': modal_coordinates are given" + but);
    if (deformable->initial_modal_rate.size() > 0)
      throw InputError("body '" + body.name + "': modal_rates are given" + but);
  }
  // Velocities that all bodies have if none are given.
  Model carried = assembly.model;
  carry_bodies(carried, assembly.starts, std::vector<bool>(carried.bodies.size(), false));
  for (std::size_t b = 0; b < carried.bodies.size(); ++b) {
    if (!assembly.moving[b]) continue;
    const Body& body = assembly.model.bodies[b];
    const Vector3d v = body.initial_velocity_m_s - carried.bodies[b].initial_velocity_m_s;
    const Vector3d w =
        body.initial_angular_velocity_rad_s - carried.bodies[b].initial_angular_velocity_rad_s;
    if (differ(v.norm(), 0) || differ(w.norm(), 0))
      throw InputError("body '" + body.name + "': velocity = " + text(body.initial_velocity_m_s) +
                       " m/s and angular_velocity = " + text(body.initial_angular_velocity_rad_s) +
                       " rad/s" + but);
  }
}

}  // namespace

void check_starts(const Assembly& assembly, const std::string& rest) {
  for (std::size_t k = 0; k < assembly.starts.size(); ++k) check_joint(assembly, k);
  if (!rest.empty()) check_rest(assembly, rest);
}

}  // namespace flexneck::pipeline
