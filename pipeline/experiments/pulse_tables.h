// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "multibody/files/history_file.h"
#include "pipeline/experiments/pendulum_tables.h"

namespace flexneck::pipeline {

/// "velocities": drop angles, velocities, the effective lengths that they imply, and what is done
/// to the pulse.
ResultTable velocity_table(const std::vector<PendulumEntry>& entries);

/// A line for each pulse that is scaled to take the arm's velocity.
std::vector<std::string> scaling_lines(const std::vector<PendulumEntry>& entries);
/// Warnings: pulses whose area is not the velocity and that are used as they are.
std::vector<std::string> pulse_warnings(const std::vector<PendulumEntry>& entries);

/// "pulse spectrum": share of each pulse's area that is left in its Fourier transform at the
/// frequencies of the system and of the neck's modes.
ResultTable spectrum_table(const Study& study, const std::vector<PendulumEntry>& entries,
                           const fe_modal::ModalBody& body);

/// The same shares at evenly spaced frequencies, a channel for each pulse.
std::vector<multibody::Channel> spectrum_curves(const Study& study,
                                                const Eigen::VectorXd& frequencies_Hz);

}  // namespace flexneck::pipeline
