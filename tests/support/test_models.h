// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "multibody/model.h"
#include "tests/support/beam_body.h"

namespace flexneck::testing {

inline constexpr double kGravity = 9.81;  ///< m/s^2

/// A model under construction: each call adds one thing and returns its index.
struct ModelBuilder {
  multibody::Model model;

  std::size_t body(const std::string& name, decltype(multibody::Body::kind) kind,
                   const multibody::Pose& pose = {},
                   const Eigen::Vector3d& velocity_m_s = Eigen::Vector3d::Zero(),
                   const Eigen::Vector3d& angular_velocity_rad_s = Eigen::Vector3d::Zero()) {
    model.bodies.push_back({name, std::move(kind), pose, velocity_m_s, angular_velocity_rad_s});
    return model.bodies.size() - 1;
  }
  std::size_t ground() { return body("ground", multibody::DrivenBody{}); }

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
  std::size_t joint(const std::string& name, multibody::JointKind kind, std::size_t marker_i,
                    std::size_t marker_j, const Eigen::Vector3d& axis = Eigen::Vector3d::UnitY()) {
    model.joints.push_back({name, kind, marker_i, marker_j, axis});
    return model.joints.size() - 1;
  }
  void force(const std::string& name, std::size_t marker, const Eigen::Vector3d& direction,
             multibody::TimeTable magnitude_N) {
    model.forces.push_back({name, marker, direction.normalized(), std::move(magnitude_N)});
  }
};

inline multibody::DeformableBody deformable(fe_modal::ModalBody modes, double damping_ratio) {
  const Eigen::Index count = modes.mode_count();
  return {std::move(modes), Eigen::VectorXd::Constant(count, damping_ratio)};
}

/// A force that is the same at all times.
inline multibody::TimeTable constant_table(double value) {
  return {{0.0}, {value}, multibody::TimeTable::Outside::constant};
}

/// A head like the Hybrid III's about the joint point, in neck axes.
inline multibody::RigidBody make_head() {
  multibody::RigidBody head;
  head.mass_kg = 4.5;
  head.center_m = {0.014, 0, 0.0508};
  head.inertia_kg_m2 << 0.01715, 0, 0.00247, 0, 0.02404, 0, 0.00247, 0, 0.02086;
  return head;
}

/// Base – fixed – neck – fixed – head, all undeformed, with the base as given.
/// Bodies: "base", "neck", "head". Markers: "base", "neck base", "neck top", "head joint", "head
/// cg". Joints: "neck base", "OC".
inline ModelBuilder head_on_neck(const multibody::DrivenBody& base, const multibody::Pose& pose,
                                 const Beam& beam, double damping_ratio,
                                 const multibody::RigidBody& head) {
  ModelBuilder build;
  const Eigen::Vector3d velocity = base.initial_velocity_m_s * base.direction;
  const Eigen::Vector3d top(0, 0, beam.length_m);
  const multibody::Pose head_pose{pose.position_m + pose.rotation * top, pose.rotation};
  const auto base_body = build.body("base", base, pose);
  const auto neck =
      build.body("neck", deformable(make_beam_body(beam), damping_ratio), pose, velocity);
  const auto head_body = build.body("head", head, head_pose, velocity);
  const auto base_marker = build.marker("base", base_body);
  const auto neck_base = build.interface_marker("neck base", neck, "base");
  const auto neck_top = build.interface_marker("neck top", neck, "top");
  const auto head_joint = build.marker("head joint", head_body);
  build.marker("head cg", head_body, head.center_m);
  build.joint("neck base", multibody::JointKind::fixed, base_marker, neck_base);
  build.joint("OC", multibody::JointKind::fixed, neck_top, head_joint);
  return build;
}

/// Neck z down, x as the world's: the pendulum's neck.
inline multibody::Pose hanging_pose() {
  return {Eigen::Vector3d::Zero(), Eigen::Quaterniond(0, 1, 0, 0)};
}

/// Rotation of column k of a marker's history, marker to world.
inline Eigen::Quaterniond rotation_at(const Eigen::Matrix4Xd& rotation, Eigen::Index k) {
  return {rotation(0, k), rotation(1, k), rotation(2, k), rotation(3, k)};
}

}  // namespace flexneck::testing
