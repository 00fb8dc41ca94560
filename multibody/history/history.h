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

/// Reaction of body i on body j through a joint, in the axes of marker i (the moving node frame on
/// a deformable body), about the joint point.
struct JointHistory {
  std::string name;
  Eigen::Matrix3Xd force_N;
  Eigen::Matrix3Xd moment_Nm;
  /// Components that the equations of motion leave undetermined because of redundant joints, such
  /// as "force y, moment x"; their recorded values are one of many solutions. Normally empty.
  std::string undetermined = {};
};

/// One of the model's measured angles, with its turns counted.
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

/// The whole state of a body that is not prescribed, with which a run may be resumed from any
/// output.
struct BodyHistory {
  std::string name;
  Eigen::Matrix3Xd position_m;              ///< position of its origin, world
  Eigen::Matrix4Xd rotation;                ///< unit quaternion body to world: w, x, y, z
  Eigen::Matrix3Xd velocity_m_s;            ///< world
  Eigen::Matrix3Xd angular_velocity_rad_s;  ///< body axes
  Eigen::MatrixXd modal;                    ///< kg^(1/2) m, (m, n); no rows for a rigid body
  Eigen::MatrixXd modal_rate;               ///< kg^(1/2) m/s
  /// See inertia_of(); may be empty.
  Eigen::VectorXd inertia = {};
};

/// States, recorded if the output options ask for them.
struct StateHistory {
  std::vector<BodyHistory> bodies;
  Eigen::MatrixXd internal;  ///< variables of the branches of sections, m and rad, one column per
                             ///< time
  /// Angles with their turns counted, rad, one column per time: of joints, "joint NAME", and
  /// measured ones, "angle NAME".
  std::vector<std::string> angle_names;
  Eigen::MatrixXd angles;
};

struct EnergyHistory {
  Eigen::VectorXd kinetic_J, gravitational_J;
  Eigen::VectorXd strain_J;  ///< stored energy of bodies, springs and bushings
  /// Energy dissipated by the damping of modes, dampers, friction and hysteresis since the start.
  Eigen::VectorXd dissipated_J;
  Eigen::VectorXd work_J;  ///< done by forces and prescribed bodies, since the start
};

/// Largest residuals of the joints in the bodies' motion; zero in the recursive form, whose
/// coordinates always satisfy them.
struct ConstraintHistory {
  Eigen::VectorXd position_m, orientation_rad;  ///< residuals of positions and of orientations
  Eigen::VectorXd velocity_m_s, angular_velocity_rad_s;  ///< their rates
};

/// Cause that limited the length of accepted steps, with the number of these steps.
struct StepLimit {
  std::string what;  ///< e.g. "error: rate of deformation of body 'neck'"
  int steps = 0;
};

struct StepStatistics {
  int accepted = 0;
  int rejected = 0;
  int evaluations = 0;               ///< number of evaluations of the equations of motion
  double max_position_residual = 0;  ///< residual of the constraints, m and rad
  double max_velocity_residual = 0;
  std::vector<StepLimit> limits;  ///< most frequent first
};

/// Results of a run at its output times.
struct History {
  Eigen::Index handed_on = 0;  ///< number of earlier outputs, which OutputOptions::sink took
  Eigen::VectorXd time_s;
  std::vector<MarkerHistory> markers;
  std::vector<JointHistory> joints;
  std::vector<AngleHistory> angles;
  std::vector<ModalHistory> modal;
  StateHistory state = {};  ///< normally empty
  EnergyHistory energy;
  ConstraintHistory constraints;
  StepStatistics statistics;
  /// Degrees of freedom that joints and motors leave at the start; negative: not known. Less the
  /// number of redundant constraints it is Gruebler's count.
  int freedoms = -1;
  /// Constraints left out at the start because they are redundant, such as "joint 'a', row 4".
  std::vector<std::string> redundant_constraints;
  std::string incomplete;  ///< reason why the run ended early; normally empty
  /// Warnings on results that are not reliable. Normally empty.
  std::vector<std::string> warnings = {};

  /// The history of a marker or joint.
  /// @throws InputError if there is none of that name.
  const MarkerHistory& marker(const std::string& name) const;
  const JointHistory& joint(const std::string& name) const;
};

}  // namespace flexneck::multibody
