// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "multibody/history.h"
#include "multibody/history_file.h"
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

/// The case's run, from the hanging equilibrium, as its file holds it.
struct PendulumRun {
  multibody::History history;                ///< at the study's output interval
  std::vector<multibody::Channel> channels;  ///< see pendulum_channels(); filtered before thinning
};

PendulumRun run_pendulum(const Study& study, const CaseSection& experiment,
                         const fe_modal::ModalBody& body);

/// What the tables show of a run.
struct PendulumResult {
  multibody::Peak head_rotation, neck_rotation, base_moment, occipital_moment;
  multibody::Peak head_acceleration;        ///< filtered
  double equilibrium_rotation = 0;          ///< head rotation at the start, rad
  std::optional<double> zero_crossing_s;    ///< of the head rotation, back through the equilibrium
  std::optional<double> run_frequency_Hz;   ///< between crossings after the pulse
  std::optional<double> run_damping_ratio;  ///< from successive peaks
};

/// @param channels  of the case's file
/// @throws InputError if one is missing.
PendulumResult pendulum_result(const Study& study, const CaseSection& experiment,
                               const Eigen::VectorXd& time_s,
                               const std::vector<multibody::Channel>& channels);

/// The lowest small motion in the plane of the case, about the hanging equilibrium, with or without
/// gravity.
multibody::SystemMode first_system_mode(const Study& study, const CaseSection& experiment,
                                        const fe_modal::ModalBody& body, bool with_gravity);

}  // namespace flexneck::pipeline
