// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/forces/bushing.h"

#include <Eigen/LU>

#include "multibody/numerics/rotation.h"

namespace flexneck::multibody {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Vector6d = Eigen::Matrix<double, 6, 1>;

}  // namespace

void Bushing::check(const std::string& who, const ForceSites& sites) const {
  check_pair(who, marker_i, marker_j, sites);
  check_stiffness(who, "stiffness", stiffness);
  check_stiffness(who, "damping", damping);
}

void Bushing::act(const ForceInput& input, ForceLoad& load, ForceEnergies& sums) const {
  const MarkerKinematics& i = input.i;
  const MarkerKinematics& j = input.j;
  const Vector3d line = j.p - i.p;
  Vector6d e;
  e.head<3>() = i.R.transpose() * line;
  e.tail<3>() = rotation_log(i.R.transpose() * j.R);
  Vector6d rate;
  rate.head<3>() = i.R.transpose() * (j.v - i.v - i.w.cross(line));
  rate.tail<3>() = i.R.transpose() * (j.w - i.w);
  const Vector6d elastic = stiffness * e;
  const Vector6d viscous = damping * rate;
  sums.stored_J += 0.5 * e.dot(elastic);
  sums.lost_W += rate.dot(viscous);
  // The angular velocity is J_l theta', and moment . J_l theta' = elastic . theta'.
  const Matrix3d J = left_jacobian(e.tail<3>());
  const Vector3d moment = J.transpose().inverse() * elastic.tail<3>() + viscous.tail<3>();
  load.force_N = -(i.R * (elastic.head<3>() + viscous.head<3>()));
  load.moment_Nm = -(i.R * moment);
}

}  // namespace flexneck::multibody
