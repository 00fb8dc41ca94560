// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace flexneck::multibody {

/// Motion of a joint's outer marker M relative to its inner one F at given coordinates.
struct JointMotion {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  ///< M axes to F axes
  Eigen::Vector3d d = Eigen::Vector3d::Zero();      ///< F to M, F axes
  /// Velocity of M relative to F is S u, M axes, linear above angular; S has a column for each rate
  /// u.
  Eigen::Matrix<double, 6, 6> S = Eigen::Matrix<double, 6, 6>::Zero();
  /// Angular part of S' u, M axes. The linear part is zero: S u is constant in F axes if u is.
  Eigen::Vector3d S_dot_u = Eigen::Vector3d::Zero();
};

/// Joint coordinates or their rates.
using Coordinates = Eigen::Ref<const Eigen::VectorXd>;

/// Axes and parameters of a joint's motion.
struct JointFrame {
  Eigen::Vector3d axis_f = Eigen::Vector3d::UnitY();  ///< F axes
  Eigen::Vector3d axis_m = Eigen::Vector3d::UnitY();  ///< M axes
  Eigen::Matrix3d R0 = Eigen::Matrix3d::Identity();   ///< universal: M to F at angles zero
  double lead_m_per_rad = 0;                          ///< screw
};

/// The free motion of a kind of joint, in coordinates q and their rates u. Distances come first. A
/// quaternion (w, x, y, z), if there is one, comes last in q, with the angular velocity in M axes
/// in u; all other rates are those of the coordinates.
struct JointMotionLaw {
  Eigen::Index rates;          ///< number of u
  Eigen::Index distances = 0;  ///< number of them, the first, that are of distances
  bool has_quaternion = false;
  bool translates = false;  ///< d is not always zero
  void (*update)(const JointFrame& frame, const Coordinates& q, const Coordinates& u,
                 JointMotion& motion);
  /// Sets the coordinates whose R and d are nearest to the given ones.
  void (*nearest)(const JointFrame& frame, const Eigen::Matrix3d& R, const Eigen::Vector3d& d,
                  Eigen::VectorXd& q);
};

inline Eigen::Matrix3d turn_about(const Eigen::Vector3d& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

/// Angle in (-pi, pi] of the rotation about the axis that is nearest to R.
double angle_about(const Eigen::Vector3d& axis, const Eigen::Matrix3d& R);

/// Two unit vectors that form a right-handed frame with the unit vector h, as rows.
Eigen::Matrix<double, 2, 3> across(const Eigen::Vector3d& h);

}  // namespace flexneck::multibody
