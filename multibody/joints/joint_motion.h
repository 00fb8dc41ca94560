// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace flexneck::multibody {

/// Relative motion of a joint's outer marker M against its inner one F at given coordinates.
struct JointMotion {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  ///< M axes to F axes
  Eigen::Vector3d d = Eigen::Vector3d::Zero();      ///< F to M, F axes
  /// Velocity of M against F is S u, M axes, linear above angular; S has a column for each rate u.
  Eigen::Matrix<double, 6, 6> S = Eigen::Matrix<double, 6, 6>::Zero();
  /// Angular, M axes. A linear one is zero: S u is to be constant in F axes where u is.
  Eigen::Vector3d S_dot_u = Eigen::Vector3d::Zero();
};

/// Joint coordinates or their rates.
using Coordinates = Eigen::Ref<const Eigen::VectorXd>;

/// What a joint's motion is about.
struct JointFrame {
  Eigen::Vector3d axis_f = Eigen::Vector3d::UnitY();  ///< F axes
  Eigen::Vector3d axis_m = Eigen::Vector3d::UnitY();  ///< M axes
  Eigen::Matrix3d R0 = Eigen::Matrix3d::Identity();   ///< universal: M to F at angles zero
  double lead_m_per_rad = 0;                          ///< screw
};

/// The motion that a kind of joint leaves free, in coordinates q and their rates u. Distances come
/// first. Where there is a quaternion (w, x, y, z), it comes last in q, and u has the angular
/// velocity in M axes for it; all other rates are those of the coordinates.
struct JointMotionLaw {
  Eigen::Index rates;          ///< how many u there are
  Eigen::Index distances = 0;  ///< how many of them, the first, are of distances
  bool has_quaternion = false;
  bool translates = false;  ///< d is not always zero
  void (*update)(const JointFrame& frame, const Coordinates& q, const Coordinates& u,
                 JointMotion& motion);
  /// The coordinates whose R and d come next to the given ones.
  void (*nearest)(const JointFrame& frame, const Eigen::Matrix3d& R, const Eigen::Vector3d& d,
                  Eigen::VectorXd& q);
};

inline Eigen::Matrix3d turn_about(const Eigen::Vector3d& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

/// Angle in (-pi, pi] of the rotation about the axis that comes next to R.
double angle_about(const Eigen::Vector3d& axis, const Eigen::Matrix3d& R);

/// Two unit vectors that make a right-handed frame with the unit vector h, as rows.
Eigen::Matrix<double, 2, 3> across(const Eigen::Vector3d& h);

}  // namespace flexneck::multibody
