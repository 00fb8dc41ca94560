// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Prescribed base, neck and head in the neck's modal coordinates alone (equations.md section 6):
// the third form of these equations, which shares nothing with the code but the model's data.
#include <cmath>
#include <numbers>

#include <Eigen/Dense>

#include "fe_modal/body/modal_body.h"
#include "multibody/model/model.h"

namespace flexneck::testing {
namespace minimal {

inline Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d result;
  result << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return result;
}

inline Eigen::Matrix3d turn_by(const Eigen::Vector3d& theta) {
  return theta.norm() > 0 ? Eigen::AngleAxisd(theta.norm(), theta.normalized()).toRotationMatrix()
                          : Eigen::Matrix3d::Identity();
}

/// Left Jacobian of the rotation vector as the mean of the intermediate rotations, J_l = int_0^1
/// exp(u ~theta) du, by five Gauss points on eight pieces.
inline Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& theta) {
  constexpr double kNodes[] = {0.046910077030668, 0.230765344947158, 0.5, 0.769234655052842,
                               0.953089922969332};
  constexpr double kWeights[] = {0.118463442528095, 0.239314335249683, 0.284444444444444,
                                 0.239314335249683, 0.118463442528095};
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int piece = 0; piece < 8; ++piece) {
    for (int k = 0; k < 5; ++k) sum += kWeights[k] / 8 * turn_by((piece + kNodes[k]) / 8 * theta);
  }
  return sum;
}

/// d/dt of left_jacobian along `rate`, by differences of fourth order.
inline Eigen::Matrix3d left_jacobian_rate(const Eigen::Vector3d& theta,
                                          const Eigen::Vector3d& rate) {
  if (rate.norm() == 0) return Eigen::Matrix3d::Zero();
  const double h = 1e-3 / rate.norm();
  const auto at = [&](double t) { return left_jacobian(theta + t * rate); };
  return (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
}

}  // namespace minimal

/// The neck's root moves with the base, the head with the neck's top: only the modal coordinates
/// are unknown.
struct MinimalModel {
  fe_modal::ModalBody neck;
  double zeta;
  multibody::RigidBody head;
  Eigen::Vector3d gravity_N;    ///< in neck axes, which the base keeps
  Eigen::Vector3d direction_N;  ///< direction of the base's acceleration, neck axes
  multibody::TimeTable acceleration;

  /// Terms of M a'' = f.
  struct Terms {
    Eigen::MatrixXd mass;
    Eigen::VectorXd load;
  };

  Eigen::VectorXd accelerations(double t, const Eigen::VectorXd& a,
                                const Eigen::VectorXd& rate) const {
    const Terms found = terms(t, a, rate);
    return found.mass.ldlt().solve(found.load);
  }

  Terms terms(double t, const Eigen::VectorXd& a, const Eigen::VectorXd& rate) const {
    const Eigen::Matrix3Xd& psi = neck.interface("top").translation;
    const Eigen::Matrix3Xd& mu = neck.interface("top").rotation;
    const Eigen::Vector3d theta = mu * a;
    const Eigen::Matrix3d R = minimal::turn_by(theta);
    const Eigen::Matrix3Xd J_mu = minimal::left_jacobian(theta) * mu;
    // In the head's axes: angular velocity, and the part of its rate that does not depend on a''.
    const Eigen::Matrix3Xd Jw = R.transpose() * J_mu;
    const Eigen::Vector3d w = Jw * rate;
    const Eigen::Vector3d w_rate =
        R.transpose() * minimal::left_jacobian_rate(theta, mu * rate) * (mu * rate);
    const Eigen::Vector3d moment = head.mass_kg * head.center_m;
    const Eigen::Matrix3d inertia = head.inertia_kg_m2 - head.mass_kg *
                                                             minimal::skew(head.center_m) *
                                                             minimal::skew(head.center_m);
    const Eigen::Vector3d base = acceleration.value(t) * direction_N - gravity_N;
    const Eigen::MatrixXd mass =
        neck.invariants.Maa +
        psi.transpose() * (head.mass_kg * psi - R * minimal::skew(moment) * Jw) +
        Jw.transpose() * (minimal::skew(moment) * R.transpose() * psi + inertia * Jw);
    const Eigen::Vector3d force =
        head.mass_kg * base - R * minimal::skew(moment) * w_rate + R * w.cross(w.cross(moment));
    const Eigen::Vector3d torque =
        moment.cross(R.transpose() * base) + inertia * w_rate + w.cross(inertia * w);
    const Eigen::ArrayXd omega = 2 * std::numbers::pi * neck.frequencies_Hz.array();
    const Eigen::VectorXd load =
        -(omega.square() * a.array() + 2 * zeta * omega * rate.array()).matrix() -
        neck.invariants.S2.transpose() * base - psi.transpose() * force - Jw.transpose() * torque;
    return {mass, load};
  }
};

}  // namespace flexneck::testing
