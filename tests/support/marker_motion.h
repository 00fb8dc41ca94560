// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "fe_modal/body/modal_body.h"

namespace flexneck::testing {

/// The rotation exp(~theta) by Eigen, not by the code under test.
inline Eigen::Matrix3d turned(const Eigen::Vector3d& theta) {
  const double angle = theta.norm();
  if (angle == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, theta / angle).toRotationMatrix();
}

/// Position and orientation of a marker in the world.
struct Frame {
  Eigen::Vector3d p;
  Eigen::Matrix3d R;
};

/// A marker at an interface of a deformable body on a given motion through t = 0 with velocities V
/// = (xdot, w, adot) and accelerations Vdot: rotation A exp(~(w t + wdot t^2 / 2)), everything else
/// a parabola. It uses only the definition of a marker's position.
struct MarkerMotion {
  const fe_modal::Interface& place;
  Eigen::Matrix3d R0;  ///< marker axes to node axes
  Eigen::Vector3d x;
  Eigen::Matrix3d A;
  Eigen::VectorXd a, V, Vdot;
  /// Data of stress stiffening: the second-order motion is minus half the work of unit loads, to
  /// which the modes contribute.
  const fe_modal::GeometricStiffness::OfInterface* loads = nullptr;
  std::vector<Eigen::MatrixXd> modal_acceleration = {};

  Frame frame(double t) const {
    const Eigen::VectorXd d = t * V + t * t / 2 * Vdot;
    const Eigen::Matrix3d body = A * turned(d.segment<3>(3));
    const Eigen::VectorXd deformed = a + d.tail(a.size());
    Eigen::VectorXd first = deformed;
    for (std::size_t k = 0; k < modal_acceleration.size(); ++k)
      first[static_cast<Eigen::Index>(k)] -= deformed.dot(modal_acceleration[k] * deformed) / 2;
    Eigen::Vector3d s = place.position_m + place.translation * first;
    Eigen::Vector3d theta = place.rotation * first;
    for (std::size_t i = 0; loads != nullptr && i < 3; ++i) {
      s[static_cast<Eigen::Index>(i)] -= deformed.dot(loads->force[i] * deformed) / 2;
      theta[static_cast<Eigen::Index>(i)] -= deformed.dot(loads->moment[i] * deformed) / 2;
    }
    return {x + d.head<3>() + body * s, body * turned(theta) * R0};
  }
};

}  // namespace flexneck::testing
