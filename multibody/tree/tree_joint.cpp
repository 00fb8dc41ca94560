// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/tree/tree_joint.h"

#include <cmath>

#include <Eigen/Geometry>

#include "geometry/foundation/error.h"
#include "multibody/numerics/rotation.h"

namespace flexneck::multibody::tree {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::VectorXd;
using ConstVector = Eigen::Ref<const VectorXd>;
using Kind = TreeJoint::Kind;

Kind kind_of(JointKind kind) {
  switch (kind) {
    case JointKind::fixed:
      return Kind::fixed;
    case JointKind::pin:
      return Kind::pin;
    case JointKind::slider:
      return Kind::slider;
    case JointKind::cylindrical:
      return Kind::cylindrical;
    case JointKind::universal:
      return Kind::universal;
    case JointKind::ball:
      return Kind::ball;
    case JointKind::free:
      break;
  }
  throw InputError("a free joint joins nothing");
}

Matrix3d turn_about(const Vector3d& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

Quaterniond quaternion(const ConstVector& q, Index first) {
  return {q[first], q[first + 1], q[first + 2], q[first + 3]};
}

/// Angle in (-pi, pi] of the rotation about the axis that comes next to R.
double angle_about(const Vector3d& axis, const Matrix3d& R) {
  const Quaterniond q(R);
  const double sign = q.w() < 0 ? -1 : 1;
  return 2 * std::atan2(sign * q.vec().dot(axis), sign * q.w());
}

}  // namespace

TreeJoint::TreeJoint(const Joint& joint, bool inner_is_i)
    : kind(kind_of(joint.kind)), axis_f(joint.axis), axis_m(joint.axis) {
  if (kind != Kind::universal) return;
  (inner_is_i ? axis_m : axis_f) = joint.second_axis;
  // Bring M's axis across F's by the smallest turn; none where the markers' axes are so already.
  Vector3d across = axis_m - axis_f.dot(axis_m) * axis_f;
  if (across.norm() < 1e-6) across = axis_f.unitOrthogonal();
  R0 = Quaterniond::FromTwoVectors(axis_m, across).toRotationMatrix();
}

void update(const TreeJoint& joint, const ConstVector& q, const ConstVector& u,
            JointMotion& motion) {
  switch (joint.kind) {
    case Kind::fixed:
      return;
    case Kind::pin:
      motion.R = turn_about(joint.axis_f, q[0]);
      motion.S.block<3, 1>(3, 0) = joint.axis_m;
      return;
    case Kind::slider:
      motion.d = q[0] * joint.axis_f;
      motion.S.block<3, 1>(0, 0) = joint.axis_m;
      return;
    case Kind::cylindrical:
      motion.d = q[0] * joint.axis_f;
      motion.R = turn_about(joint.axis_f, q[1]);
      motion.S.block<3, 1>(0, 0) = joint.axis_m;
      motion.S.block<3, 1>(3, 1) = joint.axis_m;
      return;
    case Kind::universal: {
      motion.R = turn_about(joint.axis_f, q[0]) * joint.R0 * turn_about(joint.axis_m, q[1]);
      const Vector3d first = motion.R.transpose() * joint.axis_f;
      motion.S.block<3, 1>(3, 0) = first;
      motion.S.block<3, 1>(3, 1) = joint.axis_m;
      motion.S_dot_u = u[0] * u[1] * first.cross(joint.axis_m);
      return;
    }
    case Kind::ball:
      motion.R = quaternion(q, 0).normalized().toRotationMatrix();
      motion.S.block<3, 3>(3, 0).setIdentity();
      return;
    case Kind::floating:
      motion.d = q.head<3>();
      motion.R = quaternion(q, 3).normalized().toRotationMatrix();
      motion.S.block<3, 3>(0, 0) = motion.R.transpose();
      motion.S.block<3, 3>(3, 3).setIdentity();
      return;
  }
}

void position_rate(const TreeJoint& joint, const ConstVector& q, const ConstVector& u,
                   Eigen::Ref<VectorXd> rate) {
  switch (joint.kind) {
    case Kind::ball:
      rate = quaternion_rate(q.head<4>(), u.head<3>());
      return;
    case Kind::floating:
      rate.head<3>() = u.head<3>();
      rate.tail<4>() = quaternion_rate(q.tail<4>(), u.tail<3>());
      return;
    default:
      rate = u;
  }
}

void retract(const TreeJoint& joint, const ConstVector& u, Eigen::Ref<VectorXd> q) {
  const auto turn = [&](Index first, const Vector3d& angle) {
    const Quaterniond turned = (quaternion(q, first) * quaternion_exp(angle)).normalized();
    q.segment<4>(first) << turned.w(), turned.x(), turned.y(), turned.z();
  };
  switch (joint.kind) {
    case Kind::ball:
      turn(0, u.head<3>());
      return;
    case Kind::floating:
      q.head<3>() += u.head<3>();
      turn(3, u.tail<3>());
      return;
    default:
      q += u;
  }
}

VectorXd nearest_coordinates(const TreeJoint& joint, const Matrix3d& R, const Vector3d& d) {
  VectorXd q(joint.position_count());
  const Quaterniond turn(R);
  switch (joint.kind) {
    case Kind::fixed:
      break;
    case Kind::pin:
      q << angle_about(joint.axis_f, R);
      break;
    case Kind::slider:
      q << joint.axis_f.dot(d);
      break;
    case Kind::cylindrical:
      q << joint.axis_f.dot(d), angle_about(joint.axis_f, R);
      break;
    case Kind::universal: {
      const Vector3d start = joint.R0 * joint.axis_m;
      const Vector3d now = R * joint.axis_m;
      q[0] = std::atan2(joint.axis_f.dot(start.cross(now)), start.dot(now));
      q[1] = angle_about(joint.axis_m, joint.R0.transpose() * turn_about(joint.axis_f, -q[0]) * R);
      break;
    }
    case Kind::ball:
      q << turn.w(), turn.x(), turn.y(), turn.z();
      break;
    case Kind::floating:
      q << d, turn.w(), turn.x(), turn.y(), turn.z();
      break;
  }
  return q;
}

}  // namespace flexneck::multibody::tree
