// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace flexneck::multibody {

/// Motion of a marker, one column per output time.
struct MarkerHistory {
  std::string name;
  Eigen::Matrix3Xd position_m;              ///< world
  Eigen::Matrix3Xd velocity_m_s;            ///< world
  Eigen::Matrix3Xd acceleration_m_s2;       ///< world, kinematic: gravity is not subtracted
  Eigen::Matrix4Xd rotation;                ///< unit quaternion marker to world: w, x, y, z
  Eigen::Matrix3Xd angular_velocity_rad_s;  ///< world
};

/// What body i exerts on body j through a joint, in the axes of marker i (the moving node frame on
/// a deformable body), about the joint point.
struct JointHistory {
  std::string name;
  Eigen::Matrix3Xd force_N;
  Eigen::Matrix3Xd moment_Nm;
};

/// Modal coordinates of a deformable body, one row per mode.
struct ModalHistory {
  std::string body;
  std::vector<std::string> modes;
  Eigen::MatrixXd coordinates;  ///< kg^(1/2) m
};

struct EnergyHistory {
  Eigen::VectorXd kinetic_J, gravitational_J, strain_J;
  Eigen::VectorXd dissipated_J;  ///< by modal damping, since the start
  Eigen::VectorXd work_J;        ///< done by forces and driven bodies, since the start
};

struct StepStatistics {
  int accepted = 0;
  int rejected = 0;
  int evaluations = 0;                   ///< of the equations of motion
  double largest_position_residual = 0;  ///< of the constraints, m and rad
  double largest_velocity_residual = 0;
};

/// What a run leaves, at fixed times.
struct History {
  Eigen::VectorXd time_s;
  std::vector<MarkerHistory> markers;
  std::vector<JointHistory> joints;
  std::vector<ModalHistory> modal;
  EnergyHistory energy;
  StepStatistics statistics;

  /// @throws InputError if there is none of that name.
  const MarkerHistory& marker(const std::string& name) const;
  const JointHistory& joint(const std::string& name) const;
};

}  // namespace flexneck::multibody
