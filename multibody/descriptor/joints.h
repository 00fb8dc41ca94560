// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "multibody/descriptor/coordinate_row.h"
#include "multibody/descriptor/node_kinematics.h"
#include "multibody/model/joint_check.h"
#include "multibody/model/model.h"
#include "multibody/model/motion_state.h"

namespace flexneck::multibody {

/// Largest number of rows of a joint; arrays are padded to it.
inline constexpr Eigen::Index kMaxRows = 6;
using RowVector = Eigen::Matrix<double, kMaxRows, 1>;
/// Transposed rows of a body, (6+m, kMaxRows): column r is row r of B, zero beyond the joint's
/// rows.
using TransposedRows = Eigen::Matrix<double, Eigen::Dynamic, kMaxRows, Eigen::RowMajor>;

using TwoRows = Eigen::Matrix<double, 2, 3>;

struct JointRows;

/// Constraint of the orientations of two markers.
struct RotationRows {
  Eigen::Index count;
  /// Sets T and returns the orientation's residual, one entry for each used row of T.
  Eigen::Vector3d (*orientation)(const NodeKinematics& i, const NodeKinematics& j,
                                 JointRows& joint);
  /// Terms of gamma in T's rows other than T (gr_j - gr_i).
  Eigen::Vector3d (*bias)(const NodeKinematics& i, const NodeKinematics& j, const JointRows& joint);
};

/// Constraint rows of a joint, "rows i minus j" (equations.md section 4): first those along the
/// directions D (none to 3) that constrain the positions, then those of T (none, 1, 2 or 3) for the
/// orientations:
///   B = [D P_i + L W_i, -D P_j; T W_i, -T W_j],  B Vdot = gamma,  B V + drive = velocity residual.
/// D, L and T follow from the configuration; L is zero unless marker j slides along i.
struct JointRows {
  JointRows(const Joint& joint, Eigen::Index velocity_count_i, Eigen::Index velocity_count_j);

  Eigen::Vector3d axis_i;  ///< in the axes of marker i
  Eigen::Vector3d axis_j;  ///< in the axes of marker j
  TwoRows held_i;          ///< directions of D that rotate with i, in the axes of marker i
  TwoRows across_j;        ///< unit vectors across axis_j, in the axes of marker j
  RotationRows rotation;
  TranslationConstraint translation;
  Eigen::Index translation_rows;           ///< rows of D
  double length_m;                         ///< length of a distance joint
  std::vector<CoordinateRow> coordinates;  ///< their rows come last
  Eigen::Index rows;
  Eigen::Matrix3d D = Eigen::Matrix3d::Identity();  ///< world; unused rows do not count
  Eigen::Matrix3d L = Eigen::Matrix3d::Zero();      ///< rows d x (p_i - p_j) with d of D
  Eigen::Matrix3d T = Eigen::Matrix3d::Zero();      ///< world; unused rows are zero
  TransposedRows B_i, B_j;                          ///< without rows for a prescribed body
  RowVector position_residual = RowVector::Zero();  ///< Phi
  RowVector velocity_residual = RowVector::Zero();  ///< its rate
  RowVector gamma = RowVector::Zero();

  Eigen::Index first_coordinate() const { return translation_rows + rotation.count; }
};

/// Updates D, L, T, B and Phi.
void update_configuration(const NodeKinematics& i, const NodeKinematics& j, JointRows& joint);
/// Updates the velocity residual alone.
void update_velocity_residual(const NodeKinematics& i, const NodeKinematics& j, JointRows& joint);
/// Updates the velocity residual and gamma.
void update_velocities(const NodeKinematics& i, const NodeKinematics& j, JointRows& joint);

/// Returns whether a row's residual is in metres, otherwise in radians.
bool is_length(const JointRows& joint, Eigen::Index row);

bool is_motor(const JointRows& joint, Eigen::Index row);

/// Name of a row for messages, "position row 1".
std::string name_of_row(const JointRows& joint, Eigen::Index row);

/// Norms of the parts of a residual for positions and for orientations.
Violation violation(const JointRows& joint, const RowVector& residual);

/// Reaction for the joint's multipliers, padded with zeros.
Reaction reaction(const JointRows& joint, const RowVector& multipliers);

}  // namespace flexneck::multibody
