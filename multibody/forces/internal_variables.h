// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include <Eigen/Core>

namespace flexneck::multibody {

/// Internal variables of a force element: the strains of its dashpots, six a branch, that follow
/// the motion with a delay. How the element finds them when it acts, and its answer.
struct InternalVariables {
  enum class Known {
    relaxed,  ///< not at all: at rest for long, no dashpot is loaded
    now,      ///< as they are
    begin     ///< as they were at the beginning of a step over which strains change evenly
  };

  Known known = Known::relaxed;
  const double* values = nullptr;  ///< now, or at the beginning
  const double* rates = nullptr;   ///< at the beginning, 1/s
  double length_s = 0;             ///< of the step
  double* found_values = nullptr;  ///< answer: now
  double* found_rates = nullptr;

  /// Those of a branch.
  InternalVariables of_branch(std::size_t branch) const {
    const auto part = [&](auto* all) { return all == nullptr ? all : all + 6 * branch; };
    return {known, part(values), part(rates), length_s, part(found_values), part(found_rates)};
  }
};

/// A spring and a dashpot in line, in six directions at once (a Maxwell branch).
struct MaxwellBranch {
  using Vector6d = Eigen::Matrix<double, 6, 1>;

  Eigen::Matrix<double, 6, 6> stiffness = Eigen::Matrix<double, 6, 6>::Zero();
  double relaxation_time_s = 0;

  /// The spring's part s of a strain e, whose dashpot has the rest z: z' = s / tau. Over a step of
  /// length h from s0, e0 it is the exact solution for an even change of the strain:
  /// exp(-h/tau) s0 + (1 - exp(-h/tau)) tau/h (e - e0).
  Vector6d spring_strain(const Vector6d& strain, const InternalVariables& internal) const {
    const double tau = relaxation_time_s;
    Vector6d spring = Vector6d::Zero();
    if (internal.known == InternalVariables::Known::now) {
      spring = strain - Eigen::Map<const Vector6d>(internal.values);
    } else if (internal.known == InternalVariables::Known::begin) {
      const Vector6d before = tau * Eigen::Map<const Vector6d>(internal.rates);
      const Vector6d strain_before = Eigen::Map<const Vector6d>(internal.values) + before;
      const double periods = internal.length_s / tau;
      const double kept = periods > 0 ? -std::expm1(-periods) / periods : 1;
      spring = std::exp(-periods) * before + kept * (strain - strain_before);
    }
    if (internal.found_values != nullptr) {
      Eigen::Map<Vector6d>{internal.found_values} = strain - spring;
      Eigen::Map<Vector6d>{internal.found_rates} = spring / tau;
    }
    return spring;
  }
};

}  // namespace flexneck::multibody
