// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "multibody/files/history_file.h"
#include "pipeline/experiments/pendulum_tables.h"

namespace flexneck::pipeline {

/// Fourier transform int a(t) exp(-2 pi i f t) dt in closed form of a function that is linear
/// between its samples and zero outside; at frequency 0 its integral.
/// @param times_s  strictly increasing, one per value
std::complex<double> fourier_transform(const std::vector<double>& times_s,
                                       const std::vector<double>& values, double frequency_Hz);

/// Table "velocities": drop angles, velocities, the effective lengths that they imply, and the
/// scaling of the pulse.
ResultTable velocity_table(const std::vector<PendulumEntry>& entries);

/// Lines, one for each pulse that is scaled to remove the arm's velocity.
std::vector<std::string> scaling_lines(const std::vector<PendulumEntry>& entries);
/// Warnings about pulses that are used unscaled although their area differs from the velocity.
std::vector<std::string> pulse_warnings(const std::vector<PendulumEntry>& entries);

/// Table "pulse spectrum": normalised spectrum of each pulse, its Fourier transform over its area,
/// at the frequencies of the system and of the neck's modes.
ResultTable spectrum_table(const Study& study, const std::vector<PendulumEntry>& entries,
                           const fe_modal::ModalBody& body);

/// The normalised spectra at evenly spaced frequencies, a channel for each pulse.
std::vector<multibody::Channel> spectrum_curves(const Study& study,
                                                const Eigen::VectorXd& frequencies_Hz);

}  // namespace flexneck::pipeline
