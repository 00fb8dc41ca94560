// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace flexneck::multibody {

/// Motion of a marker, one column per output time.
struct MarkerHistory {
  std::string name;
  Eigen::Matrix3Xd position_m;                   ///< world
  Eigen::Matrix3Xd velocity_m_s;                 ///< world
  Eigen::Matrix3Xd acceleration_m_s2;            ///< world, kinematic: gravity is not subtracted
  Eigen::Matrix4Xd rotation;                     ///< unit quaternion marker to world: w, x, y, z
  Eigen::Matrix3Xd angular_velocity_rad_s;       ///< world
  Eigen::Matrix3Xd angular_acceleration_rad_s2;  ///< world
};

/// What body i exerts on body j through a joint, in the axes of marker i (the moving node frame on
/// a deformable body), about the joint point.
struct JointHistory {
  std::string name;
  Eigen::Matrix3Xd force_N;
  Eigen::Matrix3Xd moment_Nm;
  /// Components that the equations of motion leave open because joints hold the same more than
  /// once, such as "force y, moment x"; what is recorded of them is one of many solutions. Empty as
  /// a rule.
  std::string undetermined = {};
};

/// One of the model's measured angles, counted over turns.
struct AngleHistory {
  std::string name;
  Eigen::VectorXd angle_rad;
};

/// Modal coordinates of a deformable body, one row per mode.
struct ModalHistory {
  std::string body;
  std::vector<std::string> modes;
  Eigen::MatrixXd coordinates;  ///< kg^(1/2) m
};

/// The whole state of a body that is not prescribed: with it a run may go on from any output.
struct BodyHistory {
  std::string name;
  Eigen::Matrix3Xd position_m;              ///< of its origin, world
  Eigen::Matrix4Xd rotation;                ///< unit quaternion body to world: w, x, y, z
  Eigen::Matrix3Xd velocity_m_s;            ///< world
  Eigen::Matrix3Xd angular_velocity_rad_s;  ///< body axes
  Eigen::MatrixXd modal;                    ///< kg^(1/2) m, (m, n); no rows for a rigid body
  Eigen::MatrixXd modal_rate;               ///< kg^(1/2) m/s
  /// See inertia_of(). Empty in files of earlier versions.
  Eigen::VectorXd inertia = {};
};

/// Where the output asks for it.
struct StateHistory {
  std::vector<BodyHistory> bodies;
  Eigen::MatrixXd internal;  ///< variables of the branches of sections, m and rad, a column a time
  /// Angles that count turns, rad, a column a time: of joints, "joint NAME", and those that are
  /// measured, "angle NAME".
  std::vector<std::string> angle_names;
  Eigen::MatrixXd angles;
};

struct EnergyHistory {
  Eigen::VectorXd kinetic_J, gravitational_J;
  Eigen::VectorXd strain_J;  ///< of bodies, springs and bushings
  /// By the damping of modes, dampers, friction and hysteresis, since the start.
  Eigen::VectorXd dissipated_J;
  Eigen::VectorXd work_J;  ///< done by forces and prescribed bodies, since the start
};

/// By how much the bodies' motion misses the joints, the largest over the joints; zero in the
/// recursive form, whose coordinates cannot miss them.
struct ConstraintHistory {
  Eigen::VectorXd position_m, orientation_rad;           ///< of positions and of orientations
  Eigen::VectorXd velocity_m_s, angular_velocity_rad_s;  ///< their rates
};

/// What set the length of accepted steps, and of how many.
struct StepLimit {
  std::string what;  ///< e.g. "error: rate of deformation of body 'neck'"
  int steps = 0;
};

struct StepStatistics {
  int accepted = 0;
  int rejected = 0;
  int evaluations = 0;               ///< of the equations of motion
  double max_position_residual = 0;  ///< of the constraints, m and rad
  double max_velocity_residual = 0;
  std::vector<StepLimit> limits;  ///< the most frequent first
};

/// What a run leaves, at fixed times.
struct History {
  Eigen::Index handed_on = 0;  ///< outputs before these, which OutputOptions::sink took
  Eigen::VectorXd time_s;
  std::vector<MarkerHistory> markers;
  std::vector<JointHistory> joints;
  std::vector<AngleHistory> angles;
  std::vector<ModalHistory> modal;
  StateHistory state = {};  ///< empty as a rule
  EnergyHistory energy;
  ConstraintHistory constraints;
  StepStatistics statistics;
  /// Independent motions that joints and motors leave at the start; negative: not known. Less the
  /// redundant constraints it is Gruebler's count.
  int freedoms = -1;
  /// Constraints left out at the start because others hold the same, such as "joint 'a', row 4".
  std::vector<std::string> redundant_constraints;
  std::string incomplete;  ///< why the run ended early; empty as a rule
  /// Sentences: what of the results is not to be trusted. Empty as a rule.
  std::vector<std::string> warnings = {};

  /// @throws InputError if there is none of that name.
  const MarkerHistory& marker(const std::string& name) const;
  const JointHistory& joint(const std::string& name) const;
};

}  // namespace flexneck::multibody
