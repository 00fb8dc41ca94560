// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "multibody/analysis/linearisation.h"
#include "multibody/files/history_file.h"
#include "multibody/history/history.h"
#include "multibody/history/incomplete_run.h"
#include "multibody/signals/response.h"
#include "multibody/simulation/simulation.h"
#include "pipeline/language/model/pulse.h"
#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

/// The pulse of a case, fitted to its impact velocity as the case says.
/// @throws InputError if it does not brake.
FittedPulse case_pulse(const Study& study, const CaseSection& experiment);

/// The head/neck pendulum: arm, neck and head hang along -z of the world, the arm moves along the
/// case's direction (flexion: neck +x, extension: -x, lateral: +y, oblique: between) with the
/// impact velocity and is brought to rest by its pulse. A translating arm moves as a whole; a
/// rotating one swings about its pivot above the neck, with velocity and pulse at its
/// accelerometer. Conventions: manual/theory/conventions.md. Its markers are "arm.end",
/// "head.condyles" and "head.cg", and those of the joints.
multibody::Model pendulum_model(const Study& study, const CaseSection& experiment,
                                const fe_modal::ModalBody& body);

/// The case's run with the content of its file. It starts from the hanging equilibrium; with a
/// rotating arm, where there is none, from the undeformed neck.
struct PendulumRun {
  multibody::History history;                ///< at the study's output interval
  std::vector<multibody::Channel> channels;  ///< see pendulum_channels(); filtered before thinning
};

/// Runs the pendulum. A run that ends early is shorter, and its history says so.
/// @throws as multibody::simulate(), IncompleteRun only if there are no outputs.
PendulumRun run_pendulum(const Study& study, const CaseSection& experiment,
                         const fe_modal::ModalBody& body);

/// Runs the pendulum without filtered channels: sampled at the study's output interval only, which
/// is several times faster. Its channels are unfiltered_channels().
PendulumRun run_pendulum_unfiltered(const Study& study, const CaseSection& experiment,
                                    const fe_modal::ModalBody& body);

/// Cost of integrating a case over its duration, with output at its end only.
struct IntegrationCost {
  double processor_s = 0;  ///< measured, for this thread
  int evaluations = 0;     ///< evaluations of the equations of motion
};

IntegrationCost integration_cost(const Study& study, const CaseSection& experiment,
                                 const fe_modal::ModalBody& body);

/// Results of a run that the tables show.
struct PendulumResult {
  /// Largest rotations in the direction in which the case throws the head.
  multibody::Peak head_rotation, neck_rotation;
  multibody::Peak base_moment, occipital_moment;  ///< largest in magnitude
  /// Filtered, largest in magnitude; NaN for a run without filtered channels.
  multibody::Peak head_acceleration;
  double equilibrium_rotation = 0;         ///< head rotation at the start, rad
  std::optional<double> zero_crossing_s;   ///< first return of the head rotation to the equilibrium
  std::optional<double> run_frequency_Hz;  ///< frequency between zero crossings after the pulse
  std::optional<double> run_damping_ratio;  ///< damping from successive peaks
};

/// Evaluates a run.
/// @param channels  channels in the case's file
/// @throws InputError if one is missing.
PendulumResult pendulum_result(const Study& study, const CaseSection& experiment,
                               const Eigen::VectorXd& time_s,
                               const std::vector<multibody::Channel>& channels);

/// The lowest mode of small motions in the plane of the case, about the hanging equilibrium, with
/// or without gravity.
multibody::SystemMode first_system_mode(const Study& study, const CaseSection& experiment,
                                        const fe_modal::ModalBody& body, bool with_gravity);

}  // namespace flexneck::pipeline
