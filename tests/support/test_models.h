// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "multibody/model/model.h"
#include "tests/support/beam_body.h"

namespace flexneck::testing {

inline constexpr double kGravity = 9.81;  ///< m/s^2

/// A model under construction: each call adds one item and returns its index.
struct ModelBuilder {
  multibody::Model model;

  std::size_t body(const std::string& name, decltype(multibody::Body::kind) kind,
                   const multibody::Pose& pose = {},
                   const Eigen::Vector3d& velocity_m_s = Eigen::Vector3d::Zero(),
                   const Eigen::Vector3d& angular_velocity_rad_s = Eigen::Vector3d::Zero()) {
    model.bodies.push_back({name, std::move(kind), pose, velocity_m_s, angular_velocity_rad_s});
    return model.bodies.size() - 1;
  }
  std::size_t ground() { return body("ground", multibody::PrescribedBody{}); }

  std::size_t marker(const std::string& name, std::size_t of_body,
                     const Eigen::Vector3d& position_m = Eigen::Vector3d::Zero(),
                     const Eigen::Quaterniond& rotation = Eigen::Quaterniond::Identity()) {
    model.markers.push_back({name, of_body, "", position_m, rotation});
    return model.markers.size() - 1;
  }
  std::size_t interface_marker(const std::string& name, std::size_t of_body,
                               const std::string& interface) {
    model.markers.push_back({name, of_body, interface});
    return model.markers.size() - 1;
  }
  std::size_t joint(const std::string& name, const multibody::JointKind* kind, std::size_t marker_i,
                    std::size_t marker_j, const Eigen::Vector3d& axis = Eigen::Vector3d::UnitY()) {
    model.joints.push_back({name, kind, marker_i, marker_j, axis});
    return model.joints.size() - 1;
  }
  void force(const std::string& name, std::size_t marker, const Eigen::Vector3d& direction,
             multibody::TimeTable magnitude_N) {
    model.forces.add(
        multibody::PointForce{name, marker, direction.normalized(), std::move(magnitude_N)});
  }
};

multibody::DeformableBody deformable(fe_modal::ModalBody modes, double damping_ratio);

/// A table of a constant force.
multibody::TimeTable constant_table(double value);

/// A head like the Hybrid III's about the joint point, in neck axes.
multibody::RigidBody make_head();

/// Base – fixed – neck – fixed – head, all undeformed, with the base as given.
/// Bodies: "base", "neck", "head". Markers: "base", "neck base", "neck top", "head joint", "head
/// cg". Joints: "neck base", "OC".
ModelBuilder head_on_neck(const multibody::PrescribedBody& base, const multibody::Pose& pose,
                          const Beam& beam, double damping_ratio, const multibody::RigidBody& head);

/// Pose of the pendulum's neck: z down, x as the world's.
multibody::Pose hanging_pose();

/// Rotation of column k of a marker's history, marker to world.
Eigen::Quaterniond rotation_at(const Eigen::Matrix4Xd& rotation, Eigen::Index k);

}  // namespace flexneck::testing
