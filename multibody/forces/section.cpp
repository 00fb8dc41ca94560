// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/forces/section.h"

#include <Eigen/LU>

#include "multibody/numerics/rotation.h"

namespace flexneck::multibody {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// sinc of half an angle, and its gradient over the rotation vector's part across the length.
struct ArcShortening {
  explicit ArcShortening(const Vector3d& across) {
    const RotationCoefficients k = rotation_coefficients(across.squaredNorm() / 4);
    ratio = k.a;
    gradient = (k.c - k.b) / 4 * across;
  }

  double ratio;
  Vector3d gradient;
};

Vector3d across(const Vector3d& theta, const Vector3d& length) {
  const double squared = length.squaredNorm();
  if (squared == 0) return Vector3d::Zero();
  return theta - (theta.dot(length) / squared) * length;
}

}  // namespace

void Section::check(const std::string& who, const ForceSites& sites) const {
  check_pair(who, marker_i, marker_j, sites);
  if (!rest_m.allFinite()) refuse_force(who, "rest length is not finite");
  check_stiffness(who, "stiffness", stiffness);
  for (std::size_t k = 0; k < branches.size(); ++k) {
    const std::string which = "branch " + std::to_string(k + 1);
    check_stiffness(who, "stiffness of " + which, branches[k].stiffness);
    if (!(branches[k].relaxation_time_s > 0 && std::isfinite(branches[k].relaxation_time_s)))
      refuse_force(who, "relaxation time of " + which + " must be positive");
  }
}

void Section::act(const ForceInput& input, ForceLoad& load, ForceEnergies& sums) const {
  const Matrix3d& R_i = input.i.R;
  const Vector3d theta = rotation_log(R_i.transpose() * input.j.R);
  const Matrix3d half = rotation_exp(theta / 2);
  const Matrix3d R_mid = R_i * half;
  const Vector3d d = R_mid.transpose() * (input.j.p - input.i.p);
  const ArcShortening arc(across(theta, rest_m));

  Vector6d strain;
  strain << d - arc.ratio * rest_m + theta.cross(rest_m) / 2, theta;
  Vector6d stress = stiffness * strain;
  sums.stored_J += strain.dot(stress) / 2;
  for (std::size_t k = 0; k < branches.size(); ++k) {
    const MaxwellBranch& branch = branches[k];
    const Vector6d spring = branch.spring_strain(strain, input.internal.of_branch(k));
    const Vector6d part = branch.stiffness * spring;
    stress += part;
    sums.stored_J += spring.dot(part) / 2;
    sums.lost_W += spring.dot(part) / branch.relaxation_time_s;
  }

  // Virtual work (equations.md section 8): of w and theta, then of the motion of j against i.
  const Vector3d f = stress.head<3>();
  const Vector3d m = stress.tail<3>() + rest_m.cross(f) / 2 - f.dot(rest_m) * arc.gradient;
  const Vector3d turning = half * f.cross(d);
  const Matrix3d J = left_jacobian(theta);
  const Vector3d moment =
      J.transpose().inverse() * (left_jacobian(theta / 2).transpose() * turning / 2 + m);
  load.force_N = -(R_mid * f);
  load.moment_Nm = -(R_i * moment);
}

}  // namespace flexneck::multibody
