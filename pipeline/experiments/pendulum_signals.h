// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "multibody/files/history_file.h"
#include "multibody/history/history.h"
#include "multibody/model/model.h"
#include "multibody/signals/cfc_filter.h"
#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

/// The upper load cell sits 0.70 in above the condyles. Regulations form the condyles' moment with
/// an arm of 0.058 ft (49 CFR 572.33) or 0.01778 m (572.133): MomentDefinition.
inline constexpr double kLoadCellHeight_m = 0.70 * 0.0254;

/// Curves over time that the paper plots, angles in rad, moments in N m about the bending axis. The
/// arm's axes are the neck's at rest; the head moves along the case's motion.
struct PendulumSignals {
  Eigen::VectorXd head_rotation;      ///< phi: rotation of the head relative to the arm
  Eigen::VectorXd neck_rotation;      ///< phi': rotation of the chord from base to joint point
  Eigen::VectorXd head_acceleration;  ///< kinematic, of the head's c.g. along the motion, m/s^2
  Eigen::VectorXd base_moment;        ///< about the arm's end, SAE J211 sign (My or Mx)
  Eigen::VectorXd occipital_moment;   ///< about the joint point
  /// Force at a virtual load cell in the head: Fx or Fy by SAE J211, N.
  Eigen::VectorXd cell_shear;
  Eigen::VectorXd cell_moment;       ///< moment at that cell: My or Mx
  Eigen::VectorXd arm_velocity;      ///< velocity of the arm's end along the motion, m/s
  Eigen::VectorXd arm_deceleration;  ///< m/s^2
};

/// Evaluates a run.
/// @param model  the model that was run: its joint on a prescribed body carries the neck, the one
/// on "head.condyles" the head; the arm has the marker "arm.end", the head "head.cg"
PendulumSignals pendulum_signals(const multibody::Model& model, const multibody::History& history,
                                 const CaseSection& experiment);

/// The condyles' moment from a load cell's channels by the regulations' formula: M = My - arm Fx in
/// the fore-aft plane and an oblique one; by the same statics M = Mx + arm Fy in the lateral one.
Eigen::VectorXd moment_by_formula(const Eigen::VectorXd& moment_Nm, const Eigen::VectorXd& shear_N,
                                  double arm_m, CaseSection::Direction direction);

/// The channels of a pendulum's file, SI units. The filter class is 1000 for the head's
/// acceleration (49 CFR 572.36); arm and classes of the load cell are the case's.
/// @throws InputError if the samples are too far apart for the filters.
std::vector<multibody::Channel> pendulum_channels(const Eigen::VectorXd& time_s,
                                                  const PendulumSignals& signals,
                                                  const CaseSection& experiment);

// Names of the filtered channels.
inline constexpr const char* kFilteredHeadAcceleration = "head acceleration filtered";
inline constexpr const char* kLoadCellMoment = "load cell moment";

/// Channels of a pendulum without the filtered ones.
std::vector<multibody::Channel> unfiltered_channels(const PendulumSignals& signals);

bool has_channel(const std::vector<multibody::Channel>& channels, const std::string& name);

/// Values of a channel, one per time. @throws InputError if there is no such channel.
Eigen::VectorXd channel_named(const std::vector<multibody::Channel>& channels,
                              const std::string& name);

}  // namespace flexneck::pipeline
