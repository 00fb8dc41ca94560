// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/joint_load.h"

#include "pipeline/experiments/bending_plane.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::Vector3d;

JointLoad joint_load(const multibody::Model& model, const multibody::History& history,
                     std::size_t joint) {
  const multibody::Joint& definition = model.joints[joint];
  const multibody::JointHistory& reaction = history.joint(definition.name);
  const multibody::MarkerHistory& i = history.marker(model.markers[definition.marker_i].name);
  const multibody::MarkerHistory& j = history.marker(model.markers[definition.marker_j].name);
  JointLoad load{reaction.force_N, reaction.moment_Nm};
  for (const multibody::JointResistance& resistance :
       model.forces.of<multibody::JointResistance>()) {
    if (resistance.joint != joint || resistance.coordinate != multibody::JointCoordinate::angle)
      continue;
    for (Index k = 0; k < load.moment_Nm.cols(); ++k) {
      const Eigen::Quaterniond to_i = rotation_at(i, k).conjugate();
      const Vector3d spin =
          to_i * Vector3d(j.angular_velocity_rad_s.col(k) - i.angular_velocity_rad_s.col(k));
      const double angle = turn_about(to_i * rotation_at(j, k), definition.axis);
      load.moment_Nm.col(k) -=
          multibody::evaluate(resistance.resistance, angle, spin.dot(definition.axis)).load *
          definition.axis;
    }
  }
  return load;
}

}  // namespace flexneck::pipeline
