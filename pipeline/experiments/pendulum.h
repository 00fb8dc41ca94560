// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "multibody/history.h"
#include "multibody/response.h"
#include "multibody/simulation.h"
#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// The head/neck pendulum: arm, neck and head hang along -z of the world, the arm moves along the
/// case's direction (flexion: neck +x, extension: -x, lateral: +y) with the impact velocity and is
/// brought to rest by its pulse, whose amplitude is scaled so that its integral is that velocity.
/// Conventions: multibody/CONVENTIONS.md. The study's bodies are named arm, neck and head, the
/// neck's interfaces base and top, its joints j1 (arm and neck) and j2 (neck and head).
multibody::Model pendulum_model(const Study& study, const CaseSection& experiment,
                                const fe_modal::ModalBody& body);

/// Curves over time that the paper plots, angles in rad, moments in N m about the axis of bending.
struct PendulumSignals {
  Eigen::VectorXd head_rotation;      ///< phi: of the head against the arm
  Eigen::VectorXd neck_rotation;      ///< phi': of the chord from base to joint point
  Eigen::VectorXd head_acceleration;  ///< of the head's c.g. along the direction of motion, m/s^2
  Eigen::VectorXd base_moment;        ///< joint j1, SAE J211 sign of the channel (My or Mx)
  Eigen::VectorXd occipital_moment;   ///< joint j2, about the joint point
};

PendulumSignals pendulum_signals(const multibody::History& history, const CaseSection& experiment);

/// What the tables show of a run.
struct PendulumResult {
  multibody::Peak head_rotation, neck_rotation, head_acceleration, base_moment, occipital_moment;
  double equilibrium_rotation = 0;          ///< head rotation at the start, rad
  std::optional<double> run_frequency_Hz;   ///< between crossings after the pulse
  std::optional<double> run_damping_ratio;  ///< from successive peaks
};

PendulumResult pendulum_result(const Study& study, const CaseSection& experiment,
                               const multibody::History& history);

/// The lowest small motion in the plane of the case, about the hanging equilibrium, with or without
/// gravity.
multibody::SystemMode first_system_mode(const Study& study, const CaseSection& experiment,
                                        const fe_modal::ModalBody& body, bool with_gravity);

}  // namespace flexneck::pipeline
