// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mesh/axis_system.h"

#include <limits>

#include <Eigen/Geometry>

#include "geometry/foundation/error.h"

namespace flexneck::mesher {
namespace {

/// Fraction of another vector below which a vector is only rounding.
constexpr double kNothing = 1e-9;
/// Fraction of the coordinates below which their difference is only rounding.
constexpr double kDigits = 4 * std::numeric_limits<double>::epsilon();

}  // namespace

Eigen::Matrix3d AxisSystem::at(const Eigen::Vector3d& position_m) const {
  if (!is_cylindrical) return axes;
  const Eigen::Vector3d arm = position_m - origin_m;
  const Eigen::Vector3d z = axes.col(2);
  const Eigen::Vector3d radial = arm - arm.dot(z) * z;
  if (!(radial.norm() > kNothing * arm.norm() + kDigits * origin_m.norm())) {
    throw InputError("a node on the axis of a cylindrical axis system has no radial direction");
  }
  Eigen::Matrix3d result;
  result.col(0) = radial.normalized();
  result.col(1) = z.cross(radial).normalized();
  result.col(2) = z;
  return result;
}

Eigen::Matrix3d axes_from(const Eigen::Vector3d& z, const Eigen::Vector3d& xz) {
  if (!(z.norm() > 0 && z.allFinite() && xz.allFinite())) {
    throw InputError("the z axis of an axis system is zero");
  }
  const Eigen::Vector3d axis = z.normalized();
  const Eigen::Vector3d any = xz.isZero(0) ? Eigen::Vector3d(axis.unitOrthogonal()) : xz;
  const Eigen::Vector3d x = any - any.dot(axis) * axis;
  if (!(x.norm() > kNothing * any.norm())) {
    throw InputError("the x axis of an axis system is parallel to its z axis");
  }
  Eigen::Matrix3d axes;
  axes.col(0) = x.normalized();
  axes.col(1) = axis.cross(x).normalized();
  axes.col(2) = axis;
  return axes;
}

}  // namespace flexneck::mesher
