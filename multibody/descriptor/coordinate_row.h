// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "multibody/descriptor/node_kinematics.h"
#include "multibody/joints/joint.h"

namespace flexneck::multibody {

/// A constraint row on a joint's coordinates, the distance s and the angle theta of marker j along
/// and about the axis of marker i: Phi = f - per_distance s - per_angle theta. For a screw joint f
/// = 0, for a motor f is its path. The residual does not count turns: it is the remainder modulo
/// per_angle full turns.
struct CoordinateRow {
  double per_distance = 0;
  double per_angle = 0;
  const JointMotor* motor = nullptr;              ///< none for a screw joint
  double value = 0, rate = 0, second_rate = 0;    ///< f and its derivatives
  Eigen::Vector3d h = Eigen::Vector3d::Zero();    ///< the axis, world
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();  ///< h x (p_i - p_j)
};

/// The rows of a joint: that of a screw joint, and those of its motors.
/// @param joint must outlive the rows
std::vector<CoordinateRow> coordinate_rows(const Joint& joint);

/// Updates h and arm.
/// @param axis in the axes of both markers
/// @return Phi
double update_configuration(const Eigen::Vector3d& axis, const NodeKinematics& i,
                            const NodeKinematics& j, CoordinateRow& row);
/// Rate of Phi.
double velocity_residual(const NodeKinematics& i, const NodeKinematics& j,
                         const CoordinateRow& row);
/// Right-hand side gamma of B Vdot = gamma.
double gamma(const NodeKinematics& i, const NodeKinematics& j, const CoordinateRow& row);

}  // namespace flexneck::multibody
