// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>

#include <Eigen/Core>

namespace flexneck::multibody {

/// Size of a step's error in units of its tolerance, and its worst component.
struct ErrorEstimate {
  double value = 0;  ///< the step is accepted below 1; NaN if any component is NaN
  std::size_t component = 0;

  /// Keeps the larger ratio. NaN wins and stays.
  void consider(std::size_t of_component, double ratio) {
    if (std::isnan(value) || ratio <= value) return;
    value = ratio;
    component = of_component;
  }
};

/// Tolerance of an error: "absolute + relative * reference".
struct Tolerance {
  double relative;
  double absolute;

  double ratio(double error, double reference) const {
    return error / (absolute + relative * reference);
  }
};

/// Amplitude of modes with the given stiffness, omega^2, as displacement and as velocity: computed
/// from a and a' / omega of each, it does not vanish where a vibration passes through zero.
struct ModalAmplitude {
  template <typename Modal>
  ModalAmplitude(const Eigen::VectorXd& stiffness, const Modal& a, const Modal& a_rate) {
    for (Eigen::Index l = 0; l < stiffness.size(); ++l) {
      const double a2 = a[l] * a[l];
      const double v2 = a_rate[l] * a_rate[l];
      displacement += a2 + v2 / stiffness[l];
      velocity += v2 + a2 * stiffness[l];
    }
    displacement = std::sqrt(displacement);
    velocity = std::sqrt(velocity);
  }

  double displacement = 0;
  double velocity = 0;
};

}  // namespace flexneck::multibody
