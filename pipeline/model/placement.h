// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "multibody/model/model.h"

namespace flexneck::pipeline {

/// Where a joint's free motions start: of j against i, along and about its axis. What the file does
/// not say is zero, or follows from where and how its bodies move.
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
/// Where a body is at time zero: a prescribed one's motion need not start from where it is given.
multibody::Pose pose_of(const multibody::Body& body);

/// Velocity of a body's origin and angular velocity at time zero, world.
struct BodyMotion {
  Eigen::Vector3d v, w;
};
BodyMotion motion_of(const multibody::Body& body);

/// Gives a pose to each body that has none, so that the joints close: walks the joints from the
/// bodies that have one. Deformable bodies have the shape that they start with. Cables without a
/// length get it from the places of their ends.
/// @param starts  one for each joint
/// @param posed   of each body
/// @throws InputError naming a body that no joint reaches.
void place_bodies(multibody::Model& model, const std::vector<JointStart>& starts,
                  std::vector<bool> posed);

/// Gives velocities to each body that has none: it moves with the one that it hangs on, and by the
/// joint's rates. A body that hangs on none stays at rest.
/// Velocities that neither the bodies' nor the joints' keys give stay open.
/// @param moving  of each body: has velocities already; prescribed bodies need none
void carry_bodies(multibody::Model& model, const std::vector<JointStart>& starts,
                  std::vector<bool> moving);

}  // namespace flexneck::pipeline
