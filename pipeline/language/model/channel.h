// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "multibody/files/history_file.h"
#include "multibody/history/history.h"
#include "multibody/signals/cfc_filter.h"

namespace flexneck::pipeline {

/// Quantity that a channel shows.
enum class Quantity {
  // Quantities of a marker, in the world or relative to another marker:
  position,
  velocity,
  acceleration,     ///< kinematic
  rotation_vector,  ///< axis times angle, the angle at most pi
  quaternion,       ///< w, x, y, z
  angle,            ///< angle of rotation about a given axis, counting full turns
  angular_velocity,
  angular_acceleration,
  accelerometer,  ///< acceleration minus gravity, in the marker's own axes
  // Loads of a joint, exerted by the lower body on the upper one:
  force,  ///< components in the axes of the lower marker
  moment,
  load_cell_force,  ///< components in the axes and with the signs of SAE J211
  load_cell_moment,
  // Quantities of the model:
  modal,  ///< coordinates of a deformable body
  energy
};

/// One or more curves derived from a history.
struct ChannelSpec {
  std::string name;
  Quantity quantity = Quantity::position;
  /// Index of the marker, measured angle, joint or deformable body in the history.
  std::size_t source = 0;
  std::optional<std::size_t> relative_to;  ///< marker of the reference frame, which may move
  std::optional<std::size_t> axes;         ///< marker along whose axes the components are
  std::optional<multibody::ChannelClass> filter;
};

/// Evaluates the channel at the history's times.
/// @throws InputError if the filter needs shorter intervals, or the history's intervals are
/// unequal.
multibody::Channel channel_of(const multibody::History& history, const ChannelSpec& spec,
                              const Eigen::Vector3d& gravity_m_s2);

/// Makes values continuous with the last of the preceding ones: quaternions without a change of
/// sign.
void continue_channel(Quantity quantity, const Eigen::VectorXd& last, Eigen::MatrixXd& values);

/// Filters rows of samples in place. If the end is not a multiple of the interval, the last
/// interval is shorter and its sample is not filtered.
/// @throws InputError as cfc_filtered().
void filter(const Eigen::VectorXd& time_s, multibody::ChannelClass cfc, Eigen::MatrixXd& values);
/// Filters all curves of a channel, which records the class.
void filter_channel(const Eigen::VectorXd& time_s, multibody::ChannelClass cfc,
                    multibody::Channel& channel);

/// Channels shown by default: position, rotation vector, velocity and acceleration of every marker,
/// force and moment of every joint, modal coordinates and energies.
std::vector<ChannelSpec> all_channels(const multibody::History& history);

}  // namespace flexneck::pipeline
