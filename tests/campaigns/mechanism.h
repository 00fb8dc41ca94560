// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "tests/campaigns/campaign.h"

namespace flexneck::multibody {
struct JointKind;
}

namespace flexneck::campaigns {

/// A rigid body at the start. The first of a mechanism is the ground.
struct Link {
  double mass_kg = 1;
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();           ///< body frame
  Eigen::Matrix3d inertia_kg_m2 = Eigen::Matrix3d::Identity();  ///< about the centre, body axes
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();         ///< position of the frame, world
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();       ///< body axes to world
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();       ///< velocity of the frame, world
  Eigen::Vector3d angular_velocity_rad_s = Eigen::Vector3d::Zero();  ///< world
};

/// A joint at the start: its frame on the inner body has the world's axes, that on the outer body
/// is rotated and displaced relative to it. Points and axes are in the world.
struct Connection {
  std::string kind;  ///< JointKind::name
  std::size_t inner = 0, outer = 0;
  bool closes_loop = false;  ///< otherwise it connects the outer body to the tree
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero(), outer_point_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();         ///< axis of the inner body
  Eigen::Vector3d second_axis = Eigen::Vector3d::UnitX();  ///< outer body's, across `axis`
  double lead_m = 0;                                       ///< lead of a screw joint, per turn
  double stiffness = 0, damping = 0;  ///< for its distance, or for its angle if it has none
};

/// A spring and damper between points of two bodies or, if `is_bushing`, along three axes that
/// rotate with the first body and are the world's at the start.
struct Strut {
  std::size_t first = 0, second = 0;
  Eigen::Vector3d first_point_m, second_point_m;  ///< world, at the start
  double stiffness = 0, damping = 0, free_length_m = 0;
  bool is_bushing = false;
  double turning_stiffness = 0;  ///< for a bushing, N m per rad of the rotation vector
};

struct Mechanism {
  std::vector<Link> links;
  std::vector<Connection> connections;
  std::vector<Strut> struts;
  Eigen::Vector3d gravity_m_s2 = Eigen::Vector3d::Zero();
  double end_s = 1;
  int outputs = 20;
  bool is_planar = false;  ///< joints leave its bodies motions in one plane only

  std::ptrdiff_t loops() const {
    return std::count_if(connections.begin(), connections.end(),
                         [](const Connection& c) { return c.closes_loop; });
  }
};

/// A random mechanism of 3 to 12 bodies with joints of all kinds, in one or several trees, with up
/// to two closed loops, springs, dampers and bushings. Velocities need not fit the joints.
Mechanism random_mechanism(Case& drawn);

Eigen::Matrix3d rotation(Case& drawn);
const multibody::JointKind& kind_of(const std::string& name);

/// Motion of all bodies but the ground, one column per output: positions, rotation matrices,
/// velocities and angular velocities in the world.
using Motion = std::array<Eigen::MatrixXd, 4>;

/// The mechanism's motion by Simbody; nothing if Simbody lacks such joints or forces, or is not
/// installed.
std::optional<Motion> simbody_motion(const Mechanism& mechanism);

}  // namespace flexneck::campaigns
