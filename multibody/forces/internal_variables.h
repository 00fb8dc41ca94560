// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include <Eigen/Core>

namespace flexneck::multibody {

/// Factors of a Maxwell branch with the relaxation time tau over a step of length h.
struct BranchStep {
  double decay = 1;  ///< exp(-h/tau): remaining fraction of the spring's strain
  double share = 1;  ///< (1 - exp(-h/tau)) tau/h: its part of an evenly changing strain

  static BranchStep over(double length_s, double relaxation_time_s) {
    const double periods = length_s / relaxation_time_s;
    return {std::exp(-periods), periods > 0 ? -std::expm1(-periods) / periods : 1};
  }
};

/// Internal variables of a force element: the strains of its dashpots, a block for each branch,
/// which follow the motion with a delay. Holds both the variables given to the element and those it
/// returns.
struct InternalVariables {
  enum class Known {
    relaxed,  ///< unknown: after a long time at rest no dashpot is loaded
    now,      ///< the present values
    begin     ///< values at the beginning of a step over which strains change evenly
  };

  Known known = Known::relaxed;
  const double* values = nullptr;     ///< present, or at the beginning
  const double* rates = nullptr;      ///< at the beginning, 1/s
  const BranchStep* steps = nullptr;  ///< factors of the branches over the step
  double* found_values = nullptr;     ///< result: present values
  double* found_rates = nullptr;

  /// The variables after those of the first `branches` branches, of `size` variables each.
  InternalVariables behind(Eigen::Index size, Eigen::Index branches = 1) const {
    const auto part = [](auto* all, Eigen::Index count) {
      return all == nullptr ? all : all + count;
    };
    const Eigen::Index count = branches * size;
    return {known,
            part(values, count),
            part(rates, count),
            part(steps, branches),
            part(found_values, count),
            part(found_rates, count)};
  }
};

/// Description of one branch's variables by the element, for sizes and messages.
struct InternalBlock {
  Eigen::Index begin = 0;  ///< index of the first among all
  /// Number of variables: a displacement, m, a rotation, rad, then further displacements, m.
  Eigen::Index size = 0;
};

/// A spring and a dashpot in series, for several strains at once (a Maxwell branch).
template <class Stiffness>
struct MaxwellBranch {
  Stiffness stiffness;
  double relaxation_time_s = 0;

  /// The spring's part s of a strain e, whose dashpot has the rest z, z' = s / tau, is share e +
  /// offset: e - z, or over a step of length h from s0, e0 the exact solution for an even change of
  /// the strain, exp(-h/tau) s0 + (1 - exp(-h/tau)) tau/h (e - e0).
  template <class Strain>
  struct SpringStrain {
    double share = 0;
    Strain offset;
    Strain of(const Strain& strain) const { return share * strain + offset; }
  };
  /// Returns the spring's part of the strain.
  /// @tparam Strain  a vector of the branch's size
  template <class Strain>
  SpringStrain<Strain> spring(const InternalVariables& internal) const {
    using Map = Eigen::Map<const Strain>;
    const Eigen::Index size = stiffness.rows();
    if (internal.known == InternalVariables::Known::relaxed) return {0, Strain::Zero(size)};
    const Map values(internal.values, size);
    if (internal.known == InternalVariables::Known::now) return {1, -values};
    const Strain before = relaxation_time_s * Map(internal.rates, size);
    const auto [decay, share] = *internal.steps;
    return {share, decay * before - share * (values + before)};
  }

  /// Writes the internal variables that belong to a spring's strain.
  template <class Strain>
  void answer(const Strain& strain, const Strain& spring, const InternalVariables& internal) const {
    if (internal.found_values == nullptr) return;
    Eigen::Map<Strain>(internal.found_values, strain.size()) = strain - spring;
    Eigen::Map<Strain>(internal.found_rates, strain.size()) = spring / relaxation_time_s;
  }
};

}  // namespace flexneck::multibody
