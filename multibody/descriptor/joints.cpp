// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/descriptor/joints.h"

#include <cmath>
#include <stdexcept>

#include "multibody/numerics/rotation.h"

namespace flexneck::multibody {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

double square(double value) { return value * value; }

Vector3d no_orientation(const NodeKinematics&, const NodeKinematics&, JointRows&) {
  return Vector3d::Zero();
}

Vector3d no_bias(const NodeKinematics&, const NodeKinematics&, const JointRows&) {
  return Vector3d::Zero();
}

/// Phi = log(R_i R_j^T).
Vector3d same_orientation(const NodeKinematics& i, const NodeKinematics& j, JointRows& joint) {
  joint.T.setIdentity();
  return rotation_log(i.R * j.R.transpose());
}

/// Phi = T (h_j x h_i) with T perpendicular to h_j, fixed in j; equivalent to eq. (12).
Vector3d common_axis(const NodeKinematics& i, const NodeKinematics& j, JointRows& joint) {
  joint.T.topRows<2>().noalias() = joint.across_j * j.R.transpose();
  return joint.T * Vector3d(j.R * joint.axis_j).cross(i.R * joint.axis_i);
}

/// T (-c_i + c_j) with c_k = h x (Om_k x (Om_k x h_k)).
Vector3d common_axis_bias(const NodeKinematics& i, const NodeKinematics& j,
                          const JointRows& joint) {
  const Vector3d h_i = i.R * joint.axis_i;
  const Vector3d h_j = j.R * joint.axis_j;
  return joint.T * h_j.cross(j.Om.cross(j.Om.cross(h_j)) - i.Om.cross(i.Om.cross(h_i)));
}

/// Phi = h_i . h_j, whose rate is (h_i x h_j) . (Om_i - Om_j).
Vector3d crossed_axes(const NodeKinematics& i, const NodeKinematics& j, JointRows& joint) {
  const Vector3d h_i = i.R * joint.axis_i;
  const Vector3d h_j = j.R * joint.axis_j;
  joint.T.row(0) = h_i.cross(h_j).transpose();
  return {h_i.dot(h_j), 0, 0};
}

/// -(h_i x h_j)' . (Om_i - Om_j).
Vector3d crossed_axes_bias(const NodeKinematics& i, const NodeKinematics& j,
                           const JointRows& joint) {
  const Vector3d h_i = i.R * joint.axis_i;
  const Vector3d h_j = j.R * joint.axis_j;
  const Vector3d turning = i.Om.cross(h_i).cross(h_j) + h_i.cross(j.Om.cross(h_j));
  return {-turning.dot(i.Om - j.Om), 0, 0};
}

RotationRows rotation_rows(RotationConstraint held) {
  switch (held) {
    case RotationConstraint::none:
      return {0, no_orientation, no_bias};
    case RotationConstraint::all:
      return {3, same_orientation, no_bias};
    case RotationConstraint::common_axis:
      return {2, common_axis, common_axis_bias};
    case RotationConstraint::crossed_axes:
      return {1, crossed_axes, crossed_axes_bias};
  }
  throw std::logic_error("unknown rows of an orientation");
}

Index translation_row_count(TranslationConstraint held) {
  switch (held) {
    case TranslationConstraint::none:
      return 0;
    case TranslationConstraint::all:
      return 3;
    case TranslationConstraint::across_axis:
      return 2;
    case TranslationConstraint::along_axis:
    case TranslationConstraint::distance:
      return 1;
  }
  throw std::logic_error("unknown rows of a position");
}

/// Unit vectors fixed to marker i along which a gap is constrained in joints whose markers may
/// separate, in its axes; unused rows are zero.
TwoRows held_directions(const Joint& joint) {
  if (joint.kind->translation == TranslationConstraint::across_axis) return across(joint.axis);
  TwoRows along = TwoRows::Zero();
  along.row(0) = joint.axis.transpose();
  return along;
}

/// True if marker j may slide on i, along an axis or in a plane.
bool slides(const JointRows& joint) {
  return joint.translation == TranslationConstraint::across_axis ||
         joint.translation == TranslationConstraint::along_axis;
}

/// True if the residual is a component of the gap, for sliding joints, or its length, for distance
/// joints.
bool is_part_of_gap(const JointRows& joint) {
  return joint.translation_rows == 1 || joint.translation_rows == 2;
}

/// Fills a column of B^T with a coordinate row's part of one body.
/// @param sign  1 for marker i, whose rotation moves the axis, -1 for marker j
void fill_row(const NodeKinematics& node, const CoordinateRow& row, double sign, Index column,
              TransposedRows& B) {
  if (B.rows() == 0) return;
  const Vector3d along = sign * row.per_distance * row.h;
  Vector3d about = sign * row.per_angle * row.h;
  if (sign > 0) about += row.per_distance * row.arm;
  B.col(column) = node.P.transpose().lazyProduct(along) + node.W.transpose().lazyProduct(about);
}

void update_coordinates(const NodeKinematics& i, const NodeKinematics& j, JointRows& joint) {
  Index r = joint.first_coordinate();
  for (CoordinateRow& row : joint.coordinates) {
    joint.position_residual[r] = update_configuration(joint.axis_i, i, j, row);
    fill_row(i, row, 1, r, joint.B_i);
    fill_row(j, row, -1, r, joint.B_j);
    ++r;
  }
}

void fill_rows(const NodeKinematics& node, const JointRows& joint, double sign, TransposedRows& B) {
  if (B.rows() == 0) return;
  if (is_part_of_gap(joint))
    B.leftCols<2>().noalias() =
        node.P.transpose().lazyProduct(sign * joint.D.topRows<2>().transpose());
  else if (joint.translation_rows == 3)
    B.leftCols<3>() = sign * node.P.transpose();
  if (joint.rotation.count == 0) return;
  const Matrix3d T_transposed = sign * joint.T.transpose();
  B.middleCols<3>(joint.translation_rows).noalias() = node.W.transpose().lazyProduct(T_transposed);
}

}  // namespace

JointRows::JointRows(const Joint& joint, Index velocity_count_i, Index velocity_count_j)
    : axis_i(joint.axis),
      axis_j(joint.kind->axes == JointAxes::two ? joint.second_axis : joint.axis),
      held_i(held_directions(joint)),
      across_j(across(axis_j)),
      rotation(rotation_rows(joint.kind->rotation)),
      translation(joint.kind->translation),
      translation_rows(translation_row_count(translation)),
      length_m(joint.length_m),
      coordinates(coordinate_rows(joint)),
      rows(translation_rows + rotation.count + static_cast<Index>(coordinates.size())),
      B_i(TransposedRows::Zero(velocity_count_i, kMaxRows)),
      B_j(TransposedRows::Zero(velocity_count_j, kMaxRows)) {}

void update_configuration(const NodeKinematics& i, const NodeKinematics& j, JointRows& joint) {
  const Index n = joint.translation_rows;
  const Vector3d gap = i.p - j.p;
  if (slides(joint)) {
    // D rotates with marker i.
    joint.D.topRows<2>().noalias() = joint.held_i * i.R.transpose();
    for (Index r = 0; r < 2; ++r) joint.L.row(r) = Vector3d(joint.D.row(r)).cross(gap).transpose();
  }
  if (joint.translation == TranslationConstraint::distance) {
    joint.D.row(0) = gap.normalized().transpose();
    joint.D.row(1).setZero();
  }
  joint.position_residual.head(n) = joint.D.topRows(n) * gap;
  if (joint.translation == TranslationConstraint::distance)
    joint.position_residual[0] -= joint.length_m;
  if (joint.rotation.count > 0)
    joint.position_residual.segment<3>(n) = joint.rotation.orientation(i, j, joint);
  fill_rows(i, joint, 1, joint.B_i);
  fill_rows(j, joint, -1, joint.B_j);
  if (slides(joint) && joint.B_i.rows() > 0)
    joint.B_i.leftCols<2>().noalias() +=
        i.W.transpose().lazyProduct(joint.L.topRows<2>().transpose());
  update_coordinates(i, j, joint);
}

void update_velocity_residual(const NodeKinematics& i, const NodeKinematics& j, JointRows& joint) {
  const Index n = joint.translation_rows;
  joint.velocity_residual.head(n) = joint.D.topRows(n) * (i.pd - j.pd);
  if (slides(joint))
    for (Index r = 0; r < n; ++r) joint.velocity_residual[r] += joint.L.row(r).dot(i.Om);
  if (joint.rotation.count > 0) joint.velocity_residual.segment<3>(n) = joint.T * (i.Om - j.Om);
  for (std::size_t k = 0; k < joint.coordinates.size(); ++k)
    joint.velocity_residual[joint.first_coordinate() + static_cast<Index>(k)] =
        velocity_residual(i, j, joint.coordinates[k]);
}

void update_velocities(const NodeKinematics& i, const NodeKinematics& j, JointRows& joint) {
  update_velocity_residual(i, j, joint);
  const Index n = joint.translation_rows;
  joint.gamma.head(n) = joint.D.topRows(n) * (j.gp - i.gp);
  if (slides(joint)) {
    // With d' = Om_i x d, (d . gap)'' also has the terms 2 d' . gap' and d'' . gap.
    const Vector3d parting = i.pd - j.pd;
    const Vector3d gap = i.p - j.p;
    for (Index r = 0; r < n; ++r) {
      const Vector3d turning = i.Om.cross(Vector3d(joint.D.row(r)));
      joint.gamma[r] -=
          joint.L.row(r).dot(i.gr) + 2 * turning.dot(parting) + i.Om.cross(turning).dot(gap);
    }
  }
  if (joint.rotation.count > 0)
    joint.gamma.segment<3>(n) = joint.T * (j.gr - i.gr) + joint.rotation.bias(i, j, joint);
  if (joint.translation == TranslationConstraint::distance) {
    // (|gap|)'' also has the term of the gap's rotation.
    const Vector3d parting = i.pd - j.pd;
    const Vector3d gap = i.p - j.p;
    joint.gamma[0] -= (parting.squaredNorm() - square(joint.velocity_residual[0])) / gap.norm();
  }
  for (std::size_t k = 0; k < joint.coordinates.size(); ++k)
    joint.gamma[joint.first_coordinate() + static_cast<Index>(k)] =
        gamma(i, j, joint.coordinates[k]);
}

bool is_length(const JointRows& joint, Index row) {
  if (row < joint.first_coordinate()) return row < joint.translation_rows;
  const auto k = static_cast<std::size_t>(row - joint.first_coordinate());
  return joint.coordinates[k].per_distance != 0;
}

bool is_motor(const JointRows& joint, Index row) {
  if (row < joint.first_coordinate()) return false;
  return joint.coordinates[static_cast<std::size_t>(row - joint.first_coordinate())].motor !=
         nullptr;
}

std::string name_of_row(const JointRows& joint, Index row) {
  if (row < joint.translation_rows) return "position row " + std::to_string(row + 1);
  if (row < joint.first_coordinate())
    return "orientation row " + std::to_string(row - joint.translation_rows + 1);
  if (!is_motor(joint, row)) return "row of the screw";
  const auto k = static_cast<std::size_t>(row - joint.first_coordinate());
  return "motor '" + joint.coordinates[k].motor->name + "'";
}

Violation violation(const JointRows& joint, const RowVector& residual) {
  Violation found{residual.head(joint.translation_rows).norm(),
                  residual.segment(joint.translation_rows, joint.rotation.count).norm()};
  for (Index row = joint.first_coordinate(); row < joint.rows; ++row) {
    double& part = is_length(joint, row) ? found.translation : found.rotation;
    part = std::hypot(part, residual[row]);
  }
  return found;
}

Reaction reaction(const JointRows& joint, const RowVector& multipliers) {
  const Index n = joint.translation_rows;
  const Index count = joint.rotation.count;
  Reaction found{joint.D.topRows(n).transpose() * multipliers.head(n),
                 joint.T.topRows(count).transpose() * multipliers.segment(n, count)};
  for (std::size_t k = 0; k < joint.coordinates.size(); ++k) {
    const CoordinateRow& row = joint.coordinates[k];
    const Vector3d load = multipliers[joint.first_coordinate() + static_cast<Index>(k)] * row.h;
    found.force_N += row.per_distance * load;
    found.moment_Nm += row.per_angle * load;
  }
  return found;
}

}  // namespace flexneck::multibody
