// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "multibody/model.h"
#include "multibody/node_kinematics.h"

namespace flexneck::multibody {

/// Rows that the largest joint has; arrays are padded to it.
inline constexpr Eigen::Index kMaxRows = 6;
using RowVector = Eigen::Matrix<double, kMaxRows, 1>;
/// Transposed rows of a body, (6+m, kMaxRows): column r is row r of B, zero beyond the joint's
/// rows.
using TransposedRows = Eigen::Matrix<double, Eigen::Dynamic, kMaxRows, Eigen::RowMajor>;

/// What tells one kind of joint from another: how orientations are held together.
struct JointLaw;

/// Constraint rows of a joint, "rows i minus j" (equations.md section 4): three rows hold the
/// positions together, and the rows of T (none, 2 or 3) the orientations:
///   B = [P_i, -P_j; T W_i, -T W_j],  B Vdot = gamma,  B V + drive = velocity residual.
/// A pin's T follows from the configuration.
struct JointRows {
  JointRows(const Joint& joint, Eigen::Index velocity_count_i, Eigen::Index velocity_count_j);

  const JointLaw* law;   ///< of static storage
  Eigen::Vector3d axis;  ///< of a pin, in the axes of both markers
  Eigen::Index rows;
  Eigen::Matrix3d T = Eigen::Matrix3d::Zero();      ///< unused rows are zero
  TransposedRows B_i, B_j;                          ///< a driven body's has no rows
  RowVector position_residual = RowVector::Zero();  ///< Phi
  RowVector velocity_residual = RowVector::Zero();  ///< its rate
  RowVector gamma = RowVector::Zero();
};

/// T, B and Phi.
void update_configuration(const NodeKinematics& i, const NodeKinematics& j, JointRows& joint);
/// The velocity residual and gamma.
void update_velocities(const NodeKinematics& i, const NodeKinematics& j, JointRows& joint);

/// Force and moment about the joint point that i exerts on j, world axes (section 4.1).
struct Reaction {
  Eigen::Vector3d force_N;
  Eigen::Vector3d moment_Nm;
};
/// From the joint's multipliers, padded with anything.
Reaction reaction(const JointRows& joint, const RowVector& multipliers);

}  // namespace flexneck::multibody
