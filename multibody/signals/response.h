// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace flexneck::multibody {

/// Characteristic values of a sampled signal for test reports. Samples are at strictly increasing
/// times; the functions throw std::invalid_argument if they are not, are not finite or are not one
/// per time.

struct Peak {
  double time_s = 0;
  double value = 0;  ///< signed, in the unit of the signal
};

/// The largest absolute value and its time, from the parabola through the largest sample and its
/// neighbours; the sample itself at either end of the signal.
Peak largest_peak(const Eigen::VectorXd& time_s, const Eigen::VectorXd& signal);

/// The free oscillation of a signal about an equilibrium from a time on.
struct FreeOscillation {
  std::vector<double> crossings_s;  ///< through the equilibrium, alternately up and down
  std::vector<Peak> peaks;          ///< one per half wave, as deviation from the equilibrium
};

/// Analyses a free oscillation. Crossings are interpolated linearly. The peak of a half wave is its
/// largest deviation, refined by a parabola. A half wave that the record cuts off has a peak only
/// if the signal turns within the record.
FreeOscillation free_oscillation(const Eigen::VectorXd& time_s, const Eigen::VectorXd& signal,
                                 double equilibrium, double after_s);

/// Damped frequency of the first full cycle, between the first crossing and the next one in the
/// same direction. Empty if the signal has too few crossings.
std::optional<double> cycle_frequency_Hz(const FreeOscillation& oscillation);

/// Fraction of critical damping from the logarithmic decrement d of the first two peaks of the same
/// sign, zeta = d / sqrt(4 pi^2 + d^2). Negative if the oscillation grows; empty without two such
/// peaks.
std::optional<double> cycle_damping_ratio(const FreeOscillation& oscillation);

}  // namespace flexneck::multibody
