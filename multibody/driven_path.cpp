// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/driven_path.h"

namespace flexneck::multibody {

using Eigen::Vector3d;

Vector3d DrivenPath::position_m(double time_s) const {
  const TimeTable& table = body.acceleration_m_s2;
  const double travel = body.initial_velocity_m_s * time_s + table.second_integral(time_s) -
                        table.second_integral(0) - table.integral(0) * time_s +
                        body.motion.displacement_m(time_s);
  return start.position_m + travel * body.direction;
}

Vector3d DrivenPath::velocity_m_s(double time_s) const {
  const TimeTable& table = body.acceleration_m_s2;
  const double speed = body.initial_velocity_m_s + table.integral(time_s) - table.integral(0) +
                       body.motion.velocity_m_s(time_s);
  return speed * body.direction;
}

Vector3d DrivenPath::acceleration_m_s2(double time_s) const {
  return (body.acceleration_m_s2.value(time_s) + body.motion.acceleration_m_s2(time_s)) *
         body.direction;
}

}  // namespace flexneck::multibody
