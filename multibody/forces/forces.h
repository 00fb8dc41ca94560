// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <Eigen/Core>

#include "multibody/forces/resistance.h"
#include "multibody/joints/joint.h"
#include "multibody/numerics/time_table.h"

namespace flexneck::multibody {

/// A force on a marker's origin, fixed in the world's axes.
struct PointForce {
  std::string name;
  std::size_t marker = 0;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< unit vector in the world
  TimeTable magnitude_N;
};

/// A torque on a marker's body, fixed in the world's axes.
struct Torque {
  std::string name;
  std::size_t marker = 0;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< unit vector in the world
  TimeTable magnitude_Nm;
};

/// A spring and damper between the origins of two markers, along the line between them. Its
/// deflection is their distance less the free length.
struct MarkerSpring {
  std::string name;
  std::size_t marker_i = 0;
  std::size_t marker_j = 0;
  double free_length_m = 0;
  Resistance resistance;
};

/// A linear spring and damper in all six directions between two markers: e = [d; theta], d the
/// place of j and theta the rotation vector of j, both against i and in i's axes. Its energy is
/// e^T K e / 2, so that its moment is the exact one of a finite rotation; the damper's load is
/// C [d'; angular velocity of j against i].
struct Bushing {
  std::string name;
  std::size_t marker_i = 0;
  std::size_t marker_j = 0;
  Eigen::Matrix<double, 6, 6> stiffness = Eigen::Matrix<double, 6, 6>::Zero();  ///< N, N m; m, rad
  Eigen::Matrix<double, 6, 6> damping = Eigen::Matrix<double, 6, 6>::Zero();    ///< per s
};

/// Spring, damper, stops and friction of a joint.
struct JointResistance {
  std::string name;
  std::size_t joint = 0;
  JointCoordinate coordinate = JointCoordinate::angle;
  Resistance resistance;
};

}  // namespace flexneck::multibody
