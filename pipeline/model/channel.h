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

/// What a channel shows.
enum class Quantity {
  // Of a marker, in the world or against another marker:
  position,
  velocity,
  acceleration,     ///< kinematic
  rotation_vector,  ///< axis times angle, the angle at most pi
  quaternion,       ///< w, x, y, z
  angle,            ///< of rotation about a given axis, which counts turns
  angular_velocity,
  angular_acceleration,
  accelerometer,  ///< acceleration less gravity, in the marker's own axes
  // Of a joint, what the lower body exerts on the upper one:
  force,  ///< in the axes of the lower marker
  moment,
  load_cell_force,  ///< in the axes and with the signs of SAE J211
  load_cell_moment,
  // Of the model:
  modal,  ///< coordinates of a deformable body
  energy
};

/// A curve or a few of them, derived from a history.
struct ChannelSpec {
  std::string name;
  Quantity quantity = Quantity::position;
  /// Marker, measured angle, joint or deformable body, as the history lists them.
  std::size_t source = 0;
  std::optional<std::size_t> relative_to;  ///< marker from whose moving frame it is seen
  std::optional<std::size_t> axes;         ///< marker along whose axes its components are
  std::optional<multibody::ChannelClass> filter;
};

/// The channel over the history's times.
/// @throws InputError if the filter needs shorter intervals, or the history has not the same
/// interval everywhere.
multibody::Channel channel_of(const multibody::History& history, const ChannelSpec& spec,
                              const Eigen::Vector3d& gravity_m_s2);

/// Makes values that follow others go on from the last of them: quaternions without a change of
/// sign.
void continue_channel(Quantity quantity, const Eigen::VectorXd& last, Eigen::MatrixXd& values);

/// Filters rows of samples in place. An end that is no multiple of the interval makes the last one
/// shorter; that sample stays as it is.
/// @throws InputError as cfc_filtered().
void filter(const Eigen::VectorXd& time_s, multibody::ChannelClass cfc, Eigen::MatrixXd& values);
/// The same for all curves of a channel, which says so.
void filter_channel(const Eigen::VectorXd& time_s, multibody::ChannelClass cfc,
                    multibody::Channel& channel);

/// Position, rotation vector, velocity and acceleration of every marker, force and moment of every
/// joint, modal coordinates and energies: what is shown if nothing is chosen.
std::vector<ChannelSpec> all_channels(const multibody::History& history);

}  // namespace flexneck::pipeline
