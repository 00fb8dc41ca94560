// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "multibody/model/model.h"
#include "multibody/numerics/prescribed_coordinate.h"

namespace flexneck::multibody {

/// Motion of a prescribed body's frame, world axes.
struct PrescribedMotion {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< body axes to world
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_velocity_rad_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration_m_s2 = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_acceleration_rad_s2 = Eigen::Vector3d::Zero();
};

/// The motion of a prescribed body: exact, by the integrals of its tables and of its functions of
/// time. It translates along a direction and turns about an axis whose point translates with it:
///   x = point + travel direction + R(angle) (x0 - point).
class PrescribedPath {
 public:
  PrescribedPath(const Pose& start, const PrescribedBody& body);

  /// @param table_time_s  time at which accelerations are read, so that a jump at the ends of an
  /// interval shows its inner side
  PrescribedMotion at(double time_s, double table_time_s) const;
  PrescribedMotion at(double time_s) const { return at(time_s, time_s); }

  /// The angle of rotation of the body, with its full turns.
  double angle_rad(double time_s) const { return angle_.value(time_s); }

 private:
  void turn(double time_s, double table_time_s, PrescribedMotion& motion) const;

  Eigen::Vector3d position_m_;  ///< at the start, as is rotation_
  Eigen::Matrix3d rotation_;
  Eigen::Vector3d direction_, axis_, point_m_;
  PrescribedCoordinate travel_, angle_;
};

/// Motion of the prescribed bodies in the equations.
enum class Drive {
  prescribed,  ///< as their tables say
  held         ///< none: they are fixed where they are at the given time
};

}  // namespace flexneck::multibody
