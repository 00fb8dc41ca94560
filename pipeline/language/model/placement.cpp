// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/model/placement.h"

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
  if (deformable->offset.size() == 0 && deformable->initial_modal.size() == 0)
    return {place.position_m, marker.rotation};
  const Eigen::VectorXd a = multibody::initial_modal(*deformable);
  return {place.position_m + place.translation * a,
          Quaterniond(multibody::rotation_exp(place.rotation * a)) * marker.rotation};
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

/// Lead of a screw joint per radian; zero for other joints.
double lead_m_per_rad(const Joint& joint) { return joint.lead_m / (2 * std::numbers::pi); }

/// Two markers, the pose of one of which gives that of the other at the start.
struct Link {
  std::size_t marker_i, marker_j;
  Pose step;  ///< pose of j in i's axes
  // Motion of j along and about an axis that has the same components in both markers' axes.
  Vector3d axis = Vector3d::UnitX();
  double speed_m_s = 0;
  double rate_rad_s = 0;
  bool is_speed_given = false;
};

Link link_of(const Joint& joint, const JointStart& start) {
  const double angle = start.angle_rad.value_or(0);
  const double rate = start.rate_rad_s.value_or(0);
  const double lead = lead_m_per_rad(joint);
  return {joint.marker_i,
          joint.marker_j,
          {(start.distance_m.value_or(0) + lead * angle) * joint.axis,
           Quaterniond(Eigen::AngleAxisd(angle, joint.axis))},
          joint.axis,
          start.speed_m_s.value_or(0) + lead * rate,
          rate,
          // A motor keeps its rate however the bodies move.
          joint.motors.empty() && (start.speed_m_s.has_value() || start.rate_rad_s.has_value())};
}

/// Links of joints, then of sections, which start without load.
std::vector<Link> links_of(const Model& model, const std::vector<JointStart>& starts) {
  std::vector<Link> links;
  for (std::size_t k = 0; k < model.joints.size(); ++k)
    if (model.joints[k].kind->motion != nullptr)
      links.push_back(link_of(model.joints[k], starts[k]));
  for (const multibody::Section& section : model.forces.of<multibody::Section>())
    links.push_back({section.marker_i, section.marker_j, {section.rest_m}});
  return links;
}

/// Calls visit(link, from, to) along the links, from finished bodies to unfinished ones.
template <class Visit>
void walk(const Model& model, const std::vector<Link>& links, std::vector<bool>& done,
          const Visit& visit) {
  for (bool progress = true; progress;) {
    progress = false;
    for (const Link& link : links) {
      const Marker* from = &model.markers[link.marker_i];
      const Marker* to = &model.markers[link.marker_j];
      if (done[to->body]) std::swap(from, to);
      if (!done[from->body] || done[to->body]) continue;
      visit(link, *from, *to);
      done[to->body] = progress = true;
    }
  }
}

}  // namespace

void place_bodies(Model& model, const std::vector<JointStart>& starts, std::vector<bool> posed) {
  walk(model, links_of(model, starts), posed,
       [&](const Link& link, const Marker& from, const Marker& to) {
         const bool outwards = &from == &model.markers[link.marker_i];
         model.bodies[to.body].initial_pose =
             pose_of(model.bodies[from.body]) * marker_pose(model, from) *
             (outwards ? link.step : inverse(link.step)) * inverse(marker_pose(model, to));
         model.bodies[to.body].initial_pose.rotation.normalize();
       });
  for (std::size_t b = 0; b < posed.size(); ++b) {
    if (posed[b]) continue;
    throw InputError("the position of body '" + model.bodies[b].name +
                     "' is not determined: no joint or section connects it to a body whose "
                     "position is known; add a joint, or give the body a position");
  }
  for (multibody::Cable& cable : model.forces.of<multibody::Cable>()) {
    if (cable.length_m != multibody::Cable::kAsPlaced) continue;
    const auto place = [&](std::size_t marker) {
      const Marker& of = model.markers[marker];
      const multibody::Pose pose = pose_of(model.bodies[of.body]) * marker_pose(model, of);
      return multibody::MarkerKinematics{.p = pose.position_m,
                                         .R = pose.rotation.toRotationMatrix()};
    };
    cable.length_m = cable.path_m(place(cable.marker_i), place(cable.marker_j));
  }
}

void carry_bodies(Model& model, const std::vector<JointStart>& starts, std::vector<bool> moving) {
  for (std::size_t b = 0; b < moving.size(); ++b) {
    moving[b] = moving[b] || std::holds_alternative<PrescribedBody>(model.bodies[b].kind);
    model.bodies[b].velocities_are_open = !moving[b];
  }
  walk(model, links_of(model, starts), moving,
       [&](const Link& link, const Marker& from, const Marker& to) {
         const Pose frame = pose_of(model.bodies[from.body]) * marker_pose(model, from);
         const bool outwards = &from == &model.markers[link.marker_i];
         const Body& carrier = model.bodies[from.body];
         Body& body = model.bodies[to.body];
         const BodyMotion motion = motion_of(carrier);
         const Vector3d axis = (outwards ? 1 : -1) * (frame.rotation * link.axis);
         const Vector3d w = motion.w + link.rate_rad_s * axis;
         const Vector3d at = (body.initial_pose * marker_pose(model, to)).position_m;
         const Vector3d v =
             motion.v + motion.w.cross(at - pose_of(carrier).position_m) + link.speed_m_s * axis;
         body.initial_velocity_m_s = v + w.cross(body.initial_pose.position_m - at);
         body.initial_angular_velocity_rad_s = body.initial_pose.rotation.conjugate() * w;
         body.velocities_are_open = !link.is_speed_given;
       });
}

}  // namespace flexneck::pipeline
