// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "multibody/model/model.h"

namespace flexneck::multibody {

/// Restoring and damping loads on the m modal coordinates of a body, equations.md section 3: on
/// mode l -stiffness_l (a_l - offset_l) - damping_l a_l'. With stress stiffening springs and
/// dampers act on e = a - 1/2 [a^T T_k a] instead of a (section 3a). Slits that open and close
/// reduce the energy as in SlitGaps. A rigid body has none.
struct ModalSprings {
  ModalSprings() = default;
  explicit ModalSprings(const DeformableBody& body);

  /// Returns whether e differs from a.
  bool curved() const { return curvatures.size() > 0; }

  /// Load against growing a_l, if e equals a.
  double load(Eigen::Index l, double a, double a_rate) const {
    return stiffness[l] * (a - offset[l]) + damping[l] * a_rate;
  }
  /// Adds `factor` times the loads against growing a to `loads`, (m), whether e equals a or not.
  template <typename Modal, typename Rate, typename Loads>
  void add_loads(const Modal& a, const Rate& a_rate, double factor, Loads&& loads) const {
    for (Eigen::Index k = 0; k < stiffness.size(); ++k) {
      const double load = factor * (stiffness[k] * (stretch(k, a) - stretch(k, offset)) +
                                    damping[k] * stretch_rate(k, a, a_rate));
      loads[k] += load;
      if (curved()) loads.noalias() -= load * curvature(k) * a;
    }
  }
  /// Adds `factor` times the gaps' part of the loads against growing a.
  template <typename Modal, typename Loads>
  void add_gap_loads(const Modal& a, double factor, Loads&& loads) const {
    if (gaps.count() > 0)
      loads.noalias() += factor * gaps.coupling.transpose() * gaps.openings_m(a - offset);
  }
  template <typename Modal>
  double energy_J(const Modal& a) const {
    double energy = gap_energy_J(a);
    for (Eigen::Index l = 0; l < stiffness.size(); ++l) {
      const double from_rest = stretch(l, a) - stretch(l, offset);
      energy += 0.5 * stiffness[l] * from_rest * from_rest;
    }
    return energy;
  }
  template <typename Modal, typename Rate>
  double lost_W(const Modal& a, const Rate& a_rate) const {
    double power = 0;
    for (Eigen::Index l = 0; l < damping.size(); ++l) {
      const double rate = stretch_rate(l, a, a_rate);
      power += damping[l] * rate * rate;
    }
    return power;
  }

  Eigen::VectorXd stiffness;   ///< omega^2, 1/s^2
  Eigen::VectorXd damping;     ///< 2 zeta omega, 1/s
  Eigen::VectorXd offset;      ///< coordinates without load
  Eigen::MatrixXd curvatures;  ///< (m m, m): T_k, one below the other; empty if e is a
  SlitGaps gaps;

 private:
  /// Energy of the gaps, never positive. At its minimum g^T K_g g is -g^T C a.
  template <typename Modal>
  double gap_energy_J(const Modal& a) const {
    if (gaps.count() == 0) return 0;
    const Eigen::VectorXd from_rest = a - offset;
    return 0.5 * gaps.openings_m(from_rest).dot(gaps.coupling * from_rest);
  }
  Eigen::Block<const Eigen::MatrixXd> curvature(Eigen::Index k) const {
    return curvatures.middleRows(k * stiffness.size(), stiffness.size());
  }
  /// Returns a^T T_k b.
  template <typename Modal, typename Other>
  double curved_product(Eigen::Index k, const Modal& a, const Other& b) const {
    double sum = 0;
    for (Eigen::Index j = 0; j < a.size(); ++j) sum += b[j] * curvature(k).col(j).dot(a);
    return sum;
  }
  /// Returns e_k.
  template <typename Modal>
  double stretch(Eigen::Index k, const Modal& a) const {
    return curved() ? a[k] - 0.5 * curved_product(k, a, a) : a[k];
  }
  template <typename Modal, typename Rate>
  double stretch_rate(Eigen::Index k, const Modal& a, const Rate& a_rate) const {
    return curved() ? a_rate[k] - curved_product(k, a, a_rate) : a_rate[k];
  }
};

}  // namespace flexneck::multibody
