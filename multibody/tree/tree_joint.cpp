// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/tree/tree_joint.h"

#include <numbers>
#include <stdexcept>

#include "multibody/numerics/rotation.h"

namespace flexneck::multibody::tree {

using Eigen::Index;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

Quaterniond quaternion(const Coordinates& q, Index first) {
  return {q[first], q[first + 1], q[first + 2], q[first + 3]};
}

void update_floating(const JointFrame&, const Coordinates& q, const Coordinates&,
                     JointMotion& motion) {
  motion.d = q.head<3>();
  motion.R = quaternion(q, 3).normalized().toRotationMatrix();
  motion.S.block<3, 3>(0, 0) = motion.R.transpose();
  motion.S.block<3, 3>(3, 3).setIdentity();
}

void nearest_floating(const JointFrame&, const Eigen::Matrix3d& R, const Vector3d& d, VectorXd& q) {
  const Quaterniond turn(R);
  q << d, turn.w(), turn.x(), turn.y(), turn.z();
}

}  // namespace

constinit const JointMotionLaw kFloatingMotion{.rates = 6,
                                               .distances = 3,
                                               .has_quaternion = true,
                                               .translates = true,
                                               .update = update_floating,
                                               .nearest = nearest_floating};

TreeJoint::TreeJoint(const Joint& joint, bool inner_is_i) : law(joint.kind->motion) {
  if (law == nullptr) throw std::logic_error("joint '" + joint.name + "' leaves no motion");
  frame.axis_f = frame.axis_m = joint.axis;
  frame.lead_m_per_rad = joint.lead_m / (2 * std::numbers::pi);
  if (joint.kind->axes != JointAxes::two) return;
  (inner_is_i ? frame.axis_m : frame.axis_f) = joint.second_axis;
  // Bring M's axis perpendicular to F's by the smallest rotation; none if the markers' axes already
  // are.
  Vector3d across = frame.axis_m - frame.axis_f.dot(frame.axis_m) * frame.axis_f;
  if (across.norm() < 1e-6) across = frame.axis_f.unitOrthogonal();
  frame.R0 = Quaterniond::FromTwoVectors(frame.axis_m, across).toRotationMatrix();
}

void position_rate(const TreeJoint& joint, const Coordinates& q, const Coordinates& u,
                   Eigen::Ref<VectorXd> rate) {
  if (!joint.law->has_quaternion) {
    rate = u;
    return;
  }
  const Index n = joint.law->rates - 3;
  rate.head(n) = u.head(n);
  rate.tail<4>() = quaternion_rate(q.tail<4>(), u.tail<3>());
}

void retract(const TreeJoint& joint, const Coordinates& u, Eigen::Ref<VectorXd> q) {
  if (!joint.law->has_quaternion) {
    q += u;
    return;
  }
  const Index n = joint.law->rates - 3;
  q.head(n) += u.head(n);
  const Quaterniond turned = (quaternion(q, n) * quaternion_exp(u.tail<3>())).normalized();
  q.tail<4>() << turned.w(), turned.x(), turned.y(), turned.z();
}

VectorXd nearest_coordinates(const TreeJoint& joint, const Eigen::Matrix3d& R, const Vector3d& d) {
  VectorXd q(joint.position_count());
  joint.law->nearest(joint.frame, R, d, q);
  return q;
}

}  // namespace flexneck::multibody::tree
