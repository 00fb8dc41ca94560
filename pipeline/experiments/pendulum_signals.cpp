// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/pendulum_signals.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "multibody/history/history.h"
#include "multibody/model/model.h"
#include "pipeline/experiments/bending_plane.h"
#include "pipeline/language/document/channel_class.h"
#include "pipeline/language/model/channel.h"

namespace flexneck::pipeline {

namespace {

/// Total load of a joint's lower body on the upper one, in the axes of marker i: the reaction,
/// which a history holds, and the loads of springs, dampers and stops on a revolute joint's angle,
/// which it does not (manual/theory/conventions.md, signs).
struct JointLoad {
  Eigen::Matrix3Xd force_N;
  Eigen::Matrix3Xd moment_Nm;  ///< about marker j's origin
};

using Eigen::Index;
using Eigen::Vector3d;

/// @param history  the model's run
/// @param joint    index among the model's joints
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

}  // namespace

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;
using multibody::Channel;
using multibody::History;
using multibody::MarkerHistory;
using multibody::Model;

namespace {

std::size_t base_joint(const Model& model) {
  for (std::size_t k = 0; k < model.joints.size(); ++k) {
    const std::size_t lower = model.markers[model.joints[k].marker_i].body;
    if (std::holds_alternative<multibody::PrescribedBody>(model.bodies[lower].kind)) return k;
  }
  throw InputError("a pendulum needs a joint whose lower marker is on its arm");
}

std::size_t head_joint(const Model& model) {
  for (std::size_t k = 0; k < model.joints.size(); ++k)
    if (model.markers[model.joints[k].marker_j].name == "head.condyles") return k;
  throw InputError("a pendulum needs a joint whose upper marker is 'head.condyles'");
}

const MarkerHistory& marker_i(const Model& model, const History& history, std::size_t joint) {
  return history.marker(model.markers[model.joints[joint].marker_i].name);
}

/// Moves the reference point of the moments to a point given relative to marker j, in axes of
/// marker i.
void refer_to(const Eigen::Matrix3Xd& point_from_j_m, JointLoad& load) {
  for (Index k = 0; k < load.moment_Nm.cols(); ++k) {
    const Vector3d r = point_from_j_m.col(k);
    const Vector3d f = load.force_N.col(k);
    load.moment_Nm.col(k) -= r.cross(f);
  }
}

void add_base(const Model& model, const History& history, const BendingPlane& plane,
              PendulumSignals& signals) {
  const std::size_t base = base_joint(model);
  const MarkerHistory& arm = history.marker("arm.end");
  const MarkerHistory& pivot = history.marker(model.markers[model.joints[base].marker_j].name);
  const MarkerHistory& carrier = marker_i(model, history, base);
  JointLoad load = joint_load(model, history, base);
  Eigen::Matrix3Xd end(3, load.force_N.cols());
  for (Index k = 0; k < end.cols(); ++k)
    end.col(k) = rotation_at(carrier, k).conjugate() *
                 Vector3d(arm.position_m.col(k) - pivot.position_m.col(k));
  refer_to(end, load);
  signals.base_moment = load.moment_Nm.transpose() * plane.moment;
}

void add_head(const Model& model, const History& history, const BendingPlane& plane,
              PendulumSignals& signals) {
  const std::size_t joint = head_joint(model);
  const MarkerHistory& head = history.marker("head.condyles");
  const MarkerHistory& top = marker_i(model, history, joint);
  JointLoad load = joint_load(model, history, joint);
  signals.occipital_moment = load.moment_Nm.transpose() * plane.moment;
  // The load cell rotates with the head.
  for (Index k = 0; k < load.force_N.cols(); ++k) {
    const Eigen::Quaterniond to_head = rotation_at(head, k).conjugate() * rotation_at(top, k);
    load.force_N.col(k) = to_head * Vector3d(load.force_N.col(k));
    load.moment_Nm.col(k) = to_head * Vector3d(load.moment_Nm.col(k));
  }
  refer_to(Vector3d(0, 0, kLoadCellHeight_m).replicate(1, load.force_N.cols()), load);
  signals.cell_shear = load.force_N.transpose() * plane.shear;
  signals.cell_moment = load.moment_Nm.transpose() * plane.moment;
}

}  // namespace

PendulumSignals pendulum_signals(const Model& model, const History& history,
                                 const CaseSection& experiment) {
  const BendingPlane plane = bending_plane(experiment);
  const MarkerHistory& top = marker_i(model, history, head_joint(model));
  const MarkerHistory& centre = history.marker("head.cg");
  const MarkerHistory& arm = history.marker("arm.end");
  const Index count = history.time_s.size();

  PendulumSignals signals;
  signals.head_rotation = relative_rotation(history.marker("head.condyles"), arm, plane);
  for (VectorXd* const signal : {&signals.neck_rotation, &signals.head_acceleration,
                                 &signals.arm_velocity, &signals.arm_deceleration})
    signal->resize(count);
  for (Index k = 0; k < count; ++k) {
    const Eigen::Quaterniond to_arm = rotation_at(arm, k).conjugate();
    const auto along = [&](const auto& vector) {
      return (to_arm * Vector3d(vector)).dot(plane.motion);
    };
    const Vector3d chord = to_arm * Vector3d(top.position_m.col(k) - arm.position_m.col(k));
    signals.neck_rotation[k] = std::atan2(chord.dot(plane.tip), chord.z());
    signals.head_acceleration[k] = along(centre.acceleration_m_s2.col(k));
    signals.arm_velocity[k] = along(arm.velocity_m_s.col(k));
    signals.arm_deceleration[k] = -along(arm.acceleration_m_s2.col(k));
  }
  add_base(model, history, plane, signals);
  add_head(model, history, plane, signals);
  return signals;
}

VectorXd moment_by_formula(const VectorXd& moment_Nm, const VectorXd& shear_N, double arm_m,
                           CaseSection::Direction direction) {
  const double sign = direction == CaseSection::Direction::lateral ? 1 : -1;
  return moment_Nm + sign * arm_m * shear_N;
}

namespace {

std::string filter_text(const MomentDefinition& moment) {
  std::string of_moment = name_of(moment.moment_filter);
  if (moment.force_filter == moment.moment_filter) return of_moment;
  return of_moment + ", force " + name_of(moment.force_filter);
}

Channel channel(const char* name, const char* unit, const VectorXd& values,
                const std::string& filter = "") {
  return {name, unit, {name}, values.transpose(), filter};
}

}  // namespace

std::vector<Channel> pendulum_channels(const VectorXd& time_s, const PendulumSignals& signals,
                                       const CaseSection& experiment) {
  using multibody::ChannelClass;
  const auto filtered = [&](const VectorXd& signal, ChannelClass cfc) {
    Eigen::MatrixXd values = signal.transpose();
    filter(time_s, cfc, values);
    return VectorXd(values.transpose());
  };
  const Channel acceleration =
      channel(kFilteredHeadAcceleration, "m/s^2",
              filtered(signals.head_acceleration, ChannelClass::cfc1000), "CFC 1000");
  const Channel moment =
      channel(kLoadCellMoment, "N*m",
              moment_by_formula(filtered(signals.cell_moment, experiment.moment.moment_filter),
                                filtered(signals.cell_shear, experiment.moment.force_filter),
                                experiment.moment.arm_m, experiment.direction),
              filter_text(experiment.moment));
  std::vector<Channel> channels = unfiltered_channels(signals);
  channels.insert(channels.begin() + 3, acceleration);  // next to the unfiltered acceleration
  channels.insert(channels.begin() + 6, moment);        // next to the other moments
  return channels;
}

std::vector<Channel> unfiltered_channels(const PendulumSignals& signals) {
  return {channel("head rotation", "rad", signals.head_rotation),
          channel("neck rotation", "rad", signals.neck_rotation),
          channel("head acceleration", "m/s^2", signals.head_acceleration),
          channel("base moment", "N*m", signals.base_moment),
          channel("occipital moment", "N*m", signals.occipital_moment),
          channel("arm velocity", "m/s", signals.arm_velocity),
          channel("arm deceleration", "m/s^2", signals.arm_deceleration)};
}

bool has_channel(const std::vector<Channel>& channels, const std::string& name) {
  return std::any_of(channels.begin(), channels.end(),
                     [&](const Channel& each) { return each.name == name; });
}

VectorXd channel_named(const std::vector<Channel>& channels, const std::string& name) {
  return channels[find_name(names_of(channels), name, "channel")].values.row(0).transpose();
}

}  // namespace flexneck::pipeline
