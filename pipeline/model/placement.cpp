// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/model/placement.h"

#include <numbers>

#include "geometry/foundation/error.h"
#include "multibody/model/prescribed_path.h"
#include "multibody/numerics/rotation.h"

namespace flexneck::pipeline {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using multibody::Body;
using multibody::DeformableBody;
using multibody::Joint;
using multibody::Marker;
using multibody::Model;
using multibody::Pose;
using multibody::PrescribedBody;

Pose operator*(const Pose& a, const Pose& b) {
  return {a.position_m + a.rotation * b.position_m, a.rotation * b.rotation};
}

Pose inverse(const Pose& a) {
  const Quaterniond back = a.rotation.conjugate();
  return {-(back * a.position_m), back};
}

Pose marker_pose(const Model& model, const Marker& marker) {
  const auto* const deformable = std::get_if<DeformableBody>(&model.bodies[marker.body].kind);
  if (deformable == nullptr) return {marker.position_m, marker.rotation};
  const fe_modal::Interface& place = deformable->modes.interface(marker.interface);
  if (deformable->offset.size() == 0) return {place.position_m, marker.rotation};
  const Vector3d theta = place.rotation * deformable->offset;
  return {place.position_m + place.translation * deformable->offset,
          Quaterniond(multibody::rotation_exp(theta)) * marker.rotation};
}

Pose pose_of(const Body& body) {
  const auto* prescribed = std::get_if<PrescribedBody>(&body.kind);
  if (prescribed == nullptr) return body.initial_pose;
  const multibody::PrescribedMotion motion =
      multibody::PrescribedPath(body.initial_pose, *prescribed).at(0);
  return {motion.position_m, Quaterniond(motion.rotation)};
}

BodyMotion motion_of(const Body& body) {
  if (const auto* prescribed = std::get_if<PrescribedBody>(&body.kind)) {
    const multibody::PrescribedMotion motion =
        multibody::PrescribedPath(body.initial_pose, *prescribed).at(0);
    return {motion.velocity_m_s, motion.angular_velocity_rad_s};
  }
  return {body.initial_velocity_m_s,
          body.initial_pose.rotation * body.initial_angular_velocity_rad_s};
}

namespace {

/// Of a screw joint; of others zero.
double lead_m_per_rad(const Joint& joint) { return joint.lead_m / (2 * std::numbers::pi); }

Pose start_pose(const Joint& joint, const JointStart& start) {
  const double angle = start.angle_rad.value_or(0);
  return {(start.distance_m.value_or(0) + lead_m_per_rad(joint) * angle) * joint.axis,
          Quaterniond(Eigen::AngleAxisd(angle, joint.axis))};
}

/// Calls visit(joint index, from, to) along the joints, from what is done to what is not.
template <class Visit>
void walk(const Model& model, std::vector<bool>& done, const Visit& visit) {
  for (bool progress = true; progress;) {
    progress = false;
    for (std::size_t k = 0; k < model.joints.size(); ++k) {
      const Joint& joint = model.joints[k];
      if (joint.kind->motion == nullptr) continue;
      const Marker* from = &model.markers[joint.marker_i];
      const Marker* to = &model.markers[joint.marker_j];
      if (done[to->body]) std::swap(from, to);
      if (!done[from->body] || done[to->body]) continue;
      visit(k, *from, *to);
      done[to->body] = progress = true;
    }
  }
}

}  // namespace

void place_bodies(Model& model, const std::vector<JointStart>& starts, std::vector<bool> posed) {
  walk(model, posed, [&](std::size_t k, const Marker& from, const Marker& to) {
    const Joint& joint = model.joints[k];
    const Pose step = start_pose(joint, starts[k]);
    const bool outwards = &from == &model.markers[joint.marker_i];
    model.bodies[to.body].initial_pose =
        pose_of(model.bodies[from.body]) * marker_pose(model, from) *
        (outwards ? step : inverse(step)) * inverse(marker_pose(model, to));
    model.bodies[to.body].initial_pose.rotation.normalize();
  });
  for (std::size_t b = 0; b < posed.size(); ++b) {
    if (posed[b]) continue;
    throw InputError("no joint connects the body '" + model.bodies[b].name +
                     "' with one whose place is known; join it, or give it a position");
  }
}

void carry_bodies(Model& model, const std::vector<JointStart>& starts, std::vector<bool> moving) {
  for (std::size_t b = 0; b < moving.size(); ++b)
    moving[b] = moving[b] || std::holds_alternative<PrescribedBody>(model.bodies[b].kind);
  walk(model, moving, [&](std::size_t k, const Marker& from, const Marker& to) {
    const Joint& joint = model.joints[k];
    const Pose frame = pose_of(model.bodies[from.body]) * marker_pose(model, from);
    const bool outwards = &from == &model.markers[joint.marker_i];
    const Body& carrier = model.bodies[from.body];
    Body& body = model.bodies[to.body];
    const BodyMotion motion = motion_of(carrier);
    // The axis is the same in both markers' axes.
    const Vector3d axis = (outwards ? 1 : -1) * (frame.rotation * joint.axis);
    const double rate = starts[k].rate_rad_s.value_or(0);
    const Vector3d w = motion.w + rate * axis;
    const Vector3d at = (body.initial_pose * marker_pose(model, to)).position_m;
    const Vector3d v = motion.v + motion.w.cross(at - pose_of(carrier).position_m) +
                       (starts[k].speed_m_s.value_or(0) + lead_m_per_rad(joint) * rate) * axis;
    body.initial_velocity_m_s = v + w.cross(body.initial_pose.position_m - at);
    body.initial_angular_velocity_rad_s = body.initial_pose.rotation.conjugate() * w;
  });
}

}  // namespace flexneck::pipeline
