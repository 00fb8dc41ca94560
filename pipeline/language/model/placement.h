// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "multibody/model/model.h"

namespace flexneck::pipeline {

/// Initial values of a joint's free motions: of j relative to i, along and about its axis. Values
/// that the file does not give are zero, or follow from the poses and velocities of its bodies.
struct JointStart {
  std::optional<double> distance_m = {};
  std::optional<double> angle_rad = {};
  std::optional<double> speed_m_s = {};
  std::optional<double> rate_rad_s = {};
};

multibody::Pose operator*(const multibody::Pose& a, const multibody::Pose& b);
multibody::Pose inverse(const multibody::Pose& a);
/// Frame of a marker in its body's frame at the start.
multibody::Pose marker_pose(const multibody::Model& model, const multibody::Marker& marker);
/// Pose of a body at time zero: a prescribed motion need not start at the given pose.
multibody::Pose pose_of(const multibody::Body& body);

/// Velocity of a body's origin and angular velocity at time zero, in world axes.
struct BodyMotion {
  Eigen::Vector3d v, w;
};
BodyMotion motion_of(const multibody::Body& body);

/// Gives a pose to each body without one, so that the joints close: walks the joints from the
/// bodies that have one. Deformable bodies have their initial shape. Cables without a length get it
/// from the distance of their ends.
/// @param starts  one per joint
/// @param posed   for each body, true if it has a pose
/// @throws InputError naming a body that no joint reaches.
void place_bodies(multibody::Model& model, const std::vector<JointStart>& starts,
                  std::vector<bool> posed);

/// Gives velocities to each body without them: it moves with the body that it is joined to, and by
/// the joint's rates. A body without a joint stays at rest. Velocities that neither the bodies' nor
/// the joints' keys give remain open.
/// @param moving  for each body, true if it has velocities; prescribed bodies need none
void carry_bodies(multibody::Model& model, const std::vector<JointStart>& starts,
                  std::vector<bool> moving);

}  // namespace flexneck::pipeline
