// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/driven_path.h"

namespace flexneck::multibody {

using Eigen::Vector3d;

Vector3d DrivenPath::position_m(double time_s) const {
  const TimeTable& table = body.acceleration_m_s2;
  const double travel = body.initial_velocity_m_s * time_s + table.second_integral(time_s) -
                        table.second_integral(0) - table.integral(0) * time_s;
  return start.position_m + travel * body.direction;
}

Vector3d DrivenPath::velocity_m_s(double time_s) const {
  const TimeTable& table = body.acceleration_m_s2;
  return (body.initial_velocity_m_s + table.integral(time_s) - table.integral(0)) * body.direction;
}

}  // namespace flexneck::multibody
