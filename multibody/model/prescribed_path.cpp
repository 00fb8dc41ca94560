// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/model/prescribed_path.h"

#include <Eigen/Geometry>

namespace flexneck::multibody {

using Eigen::Vector3d;

PrescribedPath::PrescribedPath(const Pose& start, const PrescribedBody& body)
    : position_m_(start.position_m),
      rotation_(start.rotation.normalized().toRotationMatrix()),
      direction_(body.direction),
      axis_(body.turn.axis),
      point_m_(body.turn.point_m),
      travel_(body.initial_velocity_m_s, body.acceleration_m_s2, body.motion, body.input),
      angle_(body.turn.initial_rate_rad_s, body.turn.acceleration_rad_s2, body.turn.motion,
             body.turn.input) {}

PrescribedMotion PrescribedPath::at(double time_s, double table_time_s) const {
  PrescribedMotion motion;
  motion.position_m = position_m_;
  motion.rotation = rotation_;
  if (angle_.moves()) turn(time_s, table_time_s, motion);
  if (!travel_.moves()) return motion;
  motion.position_m += travel_.value(time_s) * direction_;
  motion.velocity_m_s += travel_.rate(time_s) * direction_;
  motion.acceleration_m_s2 += travel_.second_rate(table_time_s) * direction_;
  return motion;
}

void PrescribedPath::turn(double time_s, double table_time_s, PrescribedMotion& motion) const {
  const Eigen::Matrix3d R = Eigen::AngleAxisd(angle_.value(time_s), axis_).toRotationMatrix();
  const Vector3d arm = R * (position_m_ - point_m_);
  const Vector3d w = angle_.rate(time_s) * axis_;
  const Vector3d w_rate = angle_.second_rate(table_time_s) * axis_;
  motion.position_m = point_m_ + arm;
  motion.rotation = R * rotation_;
  motion.velocity_m_s = w.cross(arm);
  motion.angular_velocity_rad_s = w;
  motion.acceleration_m_s2 = w_rate.cross(arm) + w.cross(w.cross(arm));
  motion.angular_acceleration_rad_s2 = w_rate;
}

}  // namespace flexneck::multibody
