// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/joints.h"

#include "geometry/foundation/error.h"
#include "multibody/rotation.h"

namespace flexneck::multibody {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

struct JointLaw {
  Index angular_rows;
  /// Sets T and returns the orientation's residual, T's rows used.
  Vector3d (*orientation)(const NodeKinematics& i, const NodeKinematics& j, JointRows& joint);
  /// What T gamma has besides -gr_i + gr_j, before T.
  Vector3d (*bias)(const NodeKinematics& i, const NodeKinematics& j, const JointRows& joint);
};

namespace {

Vector3d no_orientation(const NodeKinematics&, const NodeKinematics&, JointRows&) {
  return Vector3d::Zero();
}

Vector3d no_bias(const NodeKinematics&, const NodeKinematics&, const JointRows&) {
  return Vector3d::Zero();
}

/// Phi = log(R_i R_j^T).
Vector3d fixed_orientation(const NodeKinematics& i, const NodeKinematics& j, JointRows& joint) {
  joint.T.setIdentity();
  return rotation_log(i.R * j.R.transpose());
}

/// Phi = T (h_j x h_i) with T perpendicular to h_j; equivalent to eq. (12).
Vector3d pin_orientation(const NodeKinematics& i, const NodeKinematics& j, JointRows& joint) {
  const Vector3d h = j.R * joint.axis;
  Index smallest = 0;
  h.cwiseAbs().minCoeff(&smallest);
  const Vector3d first = h.cross(Vector3d::Unit(smallest)).normalized();
  joint.T.row(0) = first.transpose();
  joint.T.row(1) = h.cross(first).transpose();
  return joint.T * h.cross(i.R * joint.axis);
}

/// -c_i + c_j with c_k = h x (Om_k x (Om_k x h_k)).
Vector3d pin_bias(const NodeKinematics& i, const NodeKinematics& j, const JointRows& joint) {
  const Vector3d h_i = i.R * joint.axis;
  const Vector3d h_j = j.R * joint.axis;
  return h_j.cross(j.Om.cross(j.Om.cross(h_j)) - i.Om.cross(i.Om.cross(h_i)));
}

constexpr JointLaw kBall{0, no_orientation, no_bias};
constexpr JointLaw kPin{2, pin_orientation, pin_bias};
constexpr JointLaw kFixed{3, fixed_orientation, no_bias};

const JointLaw& law_of(JointKind kind) {
  switch (kind) {
    case JointKind::ball:
      return kBall;
    case JointKind::pin:
      return kPin;
    case JointKind::fixed:
      return kFixed;
  }
  throw InputError("unknown kind of joint");
}

void fill_rows(const NodeKinematics& node, const JointRows& joint, double sign, TransposedRows& B) {
  if (B.rows() == 0) return;
  B.leftCols<3>() = sign * node.P.transpose();
  if (joint.law->angular_rows == 0) return;
  const Matrix3d T_transposed = sign * joint.T.transpose();
  B.rightCols<3>().noalias() = node.W.transpose().lazyProduct(T_transposed);
}

}  // namespace

JointRows::JointRows(const Joint& joint, Index velocity_count_i, Index velocity_count_j)
    : law(&law_of(joint.kind)),
      axis(joint.axis),
      rows(3 + law->angular_rows),
      B_i(TransposedRows::Zero(velocity_count_i, kMaxRows)),
      B_j(TransposedRows::Zero(velocity_count_j, kMaxRows)) {}

void update_configuration(const NodeKinematics& i, const NodeKinematics& j, JointRows& joint) {
  joint.position_residual.head<3>() = i.p - j.p;
  joint.position_residual.tail<3>() = joint.law->orientation(i, j, joint);
  fill_rows(i, joint, 1, joint.B_i);
  fill_rows(j, joint, -1, joint.B_j);
}

void update_velocities(const NodeKinematics& i, const NodeKinematics& j, JointRows& joint) {
  joint.velocity_residual.head<3>() = i.pd - j.pd;
  joint.velocity_residual.tail<3>() = joint.T * (i.Om - j.Om);
  joint.gamma.head<3>() = j.gp - i.gp;
  joint.gamma.tail<3>() = joint.T * (j.gr - i.gr + joint.law->bias(i, j, joint));
}

Reaction reaction(const JointRows& joint, const RowVector& multipliers) {
  return {multipliers.head<3>(), joint.T.transpose() * multipliers.tail<3>()};
}

}  // namespace flexneck::multibody
