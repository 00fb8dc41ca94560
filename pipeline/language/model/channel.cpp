// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/model/channel.h"

#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "geometry/foundation/error.h"
#include "multibody/signals/load_cell.h"

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using multibody::Channel;
using multibody::ChannelClass;
using multibody::History;
using multibody::MarkerHistory;

namespace {

using Columns = std::vector<std::string>;

const Columns kVector = {"x", "y", "z"};

Quaterniond rotation_at(const MarkerHistory& marker, Index k) {
  const auto q = marker.rotation.col(k);
  return {q[0], q[1], q[2], q[3]};
}

/// Motion of a frame at one time, in world axes.
struct Frame {
  Vector3d p, v, a, w, alpha;
  Quaterniond R;
};

Frame frame_at(const MarkerHistory& marker, Index k) {
  return {marker.position_m.col(k),
          marker.velocity_m_s.col(k),
          marker.acceleration_m_s2.col(k),
          marker.angular_velocity_rad_s.col(k),
          marker.angular_acceleration_rad_s2.col(k),
          rotation_at(marker, k)};
}

/// Motion of one frame relative to another, moving one, still in world axes; R rotates to that
/// frame.
Frame seen_from(const Frame& frame, const Frame& from) {
  const Vector3d r = frame.p - from.p;
  const Vector3d v = frame.v - from.v - from.w.cross(r);
  const Vector3d w = frame.w - from.w;
  return {
      r,
      v,
      frame.a - from.a - from.alpha.cross(r) - from.w.cross(from.w.cross(r)) - 2 * from.w.cross(v),
      w,
      frame.alpha - from.alpha - from.w.cross(w),
      from.R.conjugate() * frame.R};
}

Vector3d rotation_vector(const Quaterniond& q) {
  const Eigen::AngleAxisd turn(q);
  return std::remainder(turn.angle(), 2 * std::numbers::pi) * turn.axis();
}

/// Vector of a marker's motion in world axes.
Vector3d vector_of(Quantity quantity, const Frame& motion) {
  switch (quantity) {
    case Quantity::position:
      return motion.p;
    case Quantity::velocity:
      return motion.v;
    case Quantity::acceleration:
      return motion.a;
    case Quantity::angular_velocity:
      return motion.w;
    case Quantity::angular_acceleration:
      return motion.alpha;
    default:
      throw ComputationError("no vector of a marker's motion");
  }
}

/// Unit of each quantity and the names of its components, except for modal coordinates.
struct Layout {
  const char* unit;
  Columns columns;
};

Layout layout_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::position:
      return {"m", kVector};
    case Quantity::velocity:
      return {"m/s", kVector};
    case Quantity::acceleration:
    case Quantity::accelerometer:
      return {"m/s^2", kVector};
    case Quantity::rotation_vector:
      return {"rad", kVector};
    case Quantity::quaternion:
      return {"1", {"w", "x", "y", "z"}};
    case Quantity::angle:
      return {"rad", {"angle"}};
    case Quantity::angular_velocity:
      return {"rad/s", kVector};
    case Quantity::angular_acceleration:
      return {"rad/s^2", kVector};
    case Quantity::force:
      return {"N", kVector};
    case Quantity::moment:
      return {"N m", kVector};
    case Quantity::load_cell_force:
      return {"N", {"Fx", "Fy", "Fz"}};
    case Quantity::load_cell_moment:
      return {"N m", {"Mx", "My", "Mz"}};
    case Quantity::modal:
      return {"kg^(1/2) m", {}};
    case Quantity::energy:
      return {"J", {"kinetic", "gravitational", "strain", "dissipated", "work", "balance"}};
  }
  throw ComputationError("no such quantity");
}

/// Rotation from world axes to the chosen ones; by default those of the reference frame.
Quaterniond to_axes(const History& history, const ChannelSpec& spec, Index k) {
  const std::optional<std::size_t> axes = spec.axes ? spec.axes : spec.relative_to;
  return axes ? rotation_at(history.markers[*axes], k).conjugate() : Quaterniond::Identity();
}

Eigen::VectorXd components_at(const History& history, const ChannelSpec& spec,
                              const Vector3d& gravity_m_s2, Index k) {
  const Frame frame = frame_at(history.markers[spec.source], k);
  if (spec.quantity == Quantity::accelerometer)
    return frame.R.conjugate() * (frame.a - gravity_m_s2);
  const Frame motion =
      spec.relative_to ? seen_from(frame, frame_at(history.markers[*spec.relative_to], k)) : frame;
  switch (spec.quantity) {
    case Quantity::rotation_vector:
      return rotation_vector(motion.R);
    case Quantity::quaternion:
      return Eigen::Vector4d(motion.R.w(), motion.R.x(), motion.R.y(), motion.R.z());
    default:
      return to_axes(history, spec, k) * vector_of(spec.quantity, motion);
  }
}

MatrixXd marker_values(const History& history, const ChannelSpec& spec,
                       const Vector3d& gravity_m_s2, Index rows) {
  MatrixXd values(rows, history.time_s.size());
  for (Index k = 0; k < values.cols(); ++k)
    values.col(k) = components_at(history, spec, gravity_m_s2, k);
  if (spec.quantity == Quantity::quaternion) {
    for (Index k = 1; k < values.cols(); ++k)
      if (values.col(k).dot(values.col(k - 1)) < 0) values.col(k) *= -1;
  }
  return values;
}

/// Values of a joint's load. The reaction is recorded in the axes of marker i, here `relative_to`.
MatrixXd joint_values(const History& history, const ChannelSpec& spec) {
  const multibody::JointHistory& joint = history.joints[spec.source];
  if (spec.quantity == Quantity::load_cell_force) return multibody::sae_j211(joint).topRows<3>();
  if (spec.quantity == Quantity::load_cell_moment)
    return multibody::sae_j211(joint).bottomRows<3>();
  MatrixXd values = spec.quantity == Quantity::force ? joint.force_N : joint.moment_Nm;
  for (Index k = 0; spec.axes && k < values.cols(); ++k) {
    const Vector3d value = values.col(k);
    values.col(k) = rotation_at(history.markers[*spec.axes], k).conjugate() *
                    (rotation_at(history.markers[*spec.relative_to], k) * value);
  }
  return values;
}

MatrixXd energy_values(const multibody::EnergyHistory& energy) {
  MatrixXd values(6, energy.work_J.size());
  values << energy.kinetic_J.transpose(), energy.gravitational_J.transpose(),
      energy.strain_J.transpose(), energy.dissipated_J.transpose(), energy.work_J.transpose(),
      (energy.kinetic_J + energy.gravitational_J + energy.strain_J + energy.dissipated_J -
       energy.work_J)
          .transpose();
  return values;
}

}  // namespace

void continue_channel(Quantity quantity, const Eigen::VectorXd& last, MatrixXd& values) {
  if (values.cols() == 0) return;
  if (quantity == Quantity::quaternion && values.col(0).dot(last) < 0) values *= -1;
}

void filter(const Eigen::VectorXd& time_s, ChannelClass cfc, MatrixXd& values) {
  Index count = time_s.size();
  if (count < 2) return;
  const double interval = time_s[1] - time_s[0];
  const double last = time_s[count - 1] - time_s[count - 2];
  if (std::abs(last - interval) > 1e-6 * interval) --count;
  for (Index row = 0; row < values.rows(); ++row) {
    const Eigen::VectorXd signal = values.row(row).head(count).transpose();
    values.row(row).head(count) = multibody::cfc_filtered(signal, interval, cfc).transpose();
  }
}

void filter_channel(const Eigen::VectorXd& time_s, ChannelClass cfc, Channel& channel) {
  channel.filter = "CFC " + std::to_string(static_cast<int>(cfc));
  filter(time_s, cfc, channel.values);
}

Channel channel_of(const History& history, const ChannelSpec& spec, const Vector3d& gravity_m_s2) {
  const Layout layout = layout_of(spec.quantity);
  Channel channel{spec.name, layout.unit, layout.columns, {}, {}};
  switch (spec.quantity) {
    case Quantity::force:
    case Quantity::moment:
    case Quantity::load_cell_force:
    case Quantity::load_cell_moment:
      channel.values = joint_values(history, spec);
      break;
    case Quantity::angle:
      channel.values = history.angles[spec.source].angle_rad.transpose();
      break;
    case Quantity::modal:
      channel.values = history.modal[spec.source].coordinates;
      channel.columns = history.modal[spec.source].modes;
      break;
    case Quantity::energy:
      channel.values = energy_values(history.energy);
      break;
    default:
      channel.values =
          marker_values(history, spec, gravity_m_s2, static_cast<Index>(layout.columns.size()));
  }
  if (spec.filter) filter_channel(history.time_s, *spec.filter, channel);
  return channel;
}

std::vector<ChannelSpec> all_channels(const History& history) {
  std::vector<ChannelSpec> specs;
  const auto add = [&](const std::string& name, Quantity quantity, std::size_t source) {
    ChannelSpec spec;
    spec.name = name;
    spec.quantity = quantity;
    spec.source = source;
    specs.push_back(spec);
  };
  for (std::size_t k = 0; k < history.markers.size(); ++k) {
    const std::string& name = history.markers[k].name;
    add(name + " position", Quantity::position, k);
    add(name + " rotation vector", Quantity::rotation_vector, k);
    add(name + " velocity", Quantity::velocity, k);
    add(name + " acceleration", Quantity::acceleration, k);
  }
  for (std::size_t k = 0; k < history.joints.size(); ++k) {
    add(history.joints[k].name + " force", Quantity::force, k);
    add(history.joints[k].name + " moment", Quantity::moment, k);
  }
  for (std::size_t k = 0; k < history.modal.size(); ++k)
    add(history.modal[k].body + " modal", Quantity::modal, k);
  add("energy", Quantity::energy, 0);
  return specs;
}

}  // namespace flexneck::pipeline
