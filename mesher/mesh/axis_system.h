// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace flexneck::mesher {

/// Axes in which supports act: Cartesian, or radial, tangential and axial at each point.
struct AxisSystem {
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns: unit vectors x, y, z
  bool is_cylindrical = false;                         ///< about z through the origin

  /// Returns whether the axes are the mesh's x, y and z.
  bool is_global() const { return !is_cylindrical && axes.isIdentity(0); }
  /// Columns: the three directions at a point.
  /// @throws InputError for a point on the axis of a cylindrical system, which has no radial
  /// direction.
  Eigen::Matrix3d at(const Eigen::Vector3d& position_m) const;
};

/// Right-handed axes from a z axis and a vector in the half plane x > 0, y = 0; any such axes if
/// that vector is zero.
/// @throws InputError if the z axis is zero, or the other vector is parallel to it.
Eigen::Matrix3d axes_from(const Eigen::Vector3d& z, const Eigen::Vector3d& xz);

}  // namespace flexneck::mesher
