// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_models.h"

#include "multibody/joints/joint_kinds.h"

namespace flexneck::testing {

multibody::DeformableBody deformable(fe_modal::ModalBody modes, double damping_ratio) {
  const Eigen::Index count = modes.mode_count();
  return {std::move(modes), Eigen::VectorXd::Constant(count, damping_ratio)};
}

multibody::TimeTable constant_table(double value) {
  return {{0.0}, {value}, multibody::TimeTable::Outside::constant};
}

multibody::RigidBody make_head() {
  multibody::RigidBody head;
  head.mass_kg = 4.5;
  head.center_m = {0.014, 0, 0.0508};
  head.inertia_kg_m2 << 0.01715, 0, 0.00247, 0, 0.02404, 0, 0.00247, 0, 0.02086;
  return head;
}

ModelBuilder head_on_neck(const multibody::PrescribedBody& base, const multibody::Pose& pose,
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
  build.joint("neck base", &multibody::kFixedJoint, base_marker, neck_base);
  build.joint("OC", &multibody::kFixedJoint, neck_top, head_joint);
  return build;
}

multibody::Pose hanging_pose() { return {Eigen::Vector3d::Zero(), Eigen::Quaterniond(0, 1, 0, 0)}; }

Eigen::Quaterniond rotation_at(const Eigen::Matrix4Xd& rotation, Eigen::Index k) {
  return {rotation(0, k), rotation(1, k), rotation(2, k), rotation(3, k)};
}

}  // namespace flexneck::testing
