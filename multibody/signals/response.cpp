// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/signals/response.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

void check_signal(const VectorXd& time_s, const VectorXd& signal) {
  if (time_s.size() != signal.size() || time_s.size() == 0) {
    throw std::invalid_argument("a signal needs one value per time");
  }
  if (!time_s.allFinite() || !signal.allFinite()) {
    throw std::invalid_argument("a signal must be finite");
  }
  for (Index k = 1; k < time_s.size(); ++k) {
    if (!(time_s[k] > time_s[k - 1])) throw std::invalid_argument("times must increase");
  }
}

/// Vertex of the parabola through samples k - 1, k, k + 1, of which k is the extreme one.
Peak parabola_vertex(const VectorXd& time_s, const VectorXd& signal, Index k) {
  const double before = time_s[k] - time_s[k - 1];
  const double after = time_s[k + 1] - time_s[k];
  const double slope_before = (signal[k] - signal[k - 1]) / before;
  const double slope_after = (signal[k + 1] - signal[k]) / after;
  const double curvature = (slope_after - slope_before) / (before + after);
  if (curvature == 0) return {time_s[k], signal[k]};
  const double slope = (slope_before * after + slope_after * before) / (before + after);
  const double shift = -slope / (2 * curvature);
  return {time_s[k] + shift, signal[k] + slope * shift / 2};
}

/// Peak of the samples first … last of one half wave; empty if the record ends before the signal
/// turns.
std::optional<Peak> half_wave_peak(const VectorXd& time_s, const VectorXd& deviation, Index first,
                                   Index last) {
  Index k = 0;
  deviation.segment(first, last - first + 1).cwiseAbs().maxCoeff(&k);
  k += first;
  if (k == 0 || k + 1 == deviation.size()) return std::nullopt;
  const double size = std::abs(deviation[k]);
  const double sign = deviation[k] < 0 ? -1 : 1;
  if (sign * deviation[k - 1] > size || sign * deviation[k + 1] > size) return std::nullopt;
  return parabola_vertex(time_s, deviation, k);
}

}  // namespace

Peak largest_peak(const VectorXd& time_s, const VectorXd& signal) {
  check_signal(time_s, signal);
  Index k = 0;
  signal.cwiseAbs().maxCoeff(&k);
  if (k == 0 || k + 1 == signal.size()) return {time_s[k], signal[k]};
  return parabola_vertex(time_s, signal, k);
}

FreeOscillation free_oscillation(const VectorXd& time_s, const VectorXd& signal, double equilibrium,
                                 double after_s) {
  check_signal(time_s, signal);
  const VectorXd deviation = signal.array() - equilibrium;
  FreeOscillation found;
  Index first = 0;
  while (first < time_s.size() && time_s[first] < after_s) ++first;
  const auto add_peak = [&](Index last) {
    if (const auto peak = half_wave_peak(time_s, deviation, first, last)) {
      found.peaks.push_back(*peak);
    }
  };
  double sign = 0;
  for (Index k = first; k < deviation.size(); ++k) {
    if (deviation[k] == 0) continue;
    if (sign * deviation[k] < 0) {
      const double step = time_s[k] - time_s[k - 1];
      found.crossings_s.push_back(time_s[k] -
                                  step * deviation[k] / (deviation[k] - deviation[k - 1]));
      add_peak(k - 1);
      first = k;
    }
    sign = deviation[k] < 0 ? -1 : 1;
  }
  if (sign != 0) add_peak(deviation.size() - 1);
  return found;
}

std::optional<double> cycle_frequency_Hz(const FreeOscillation& oscillation) {
  if (oscillation.crossings_s.size() < 3) return std::nullopt;
  return 1 / (oscillation.crossings_s[2] - oscillation.crossings_s[0]);
}

std::optional<double> cycle_damping_ratio(const FreeOscillation& oscillation) {
  if (oscillation.peaks.size() < 3) return std::nullopt;
  const double decrement = std::log(oscillation.peaks[0].value / oscillation.peaks[2].value);
  return decrement / std::hypot(2 * std::numbers::pi, decrement);
}

}  // namespace flexneck::multibody
