// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/body/modal_body.h"

namespace flexneck::fe_modal {

/// Contributions of each vector of a basis to the body's inertia and to its interfaces' compliance:
/// they show whether there are enough modes.
struct BasisTable {
  /// (m, 3): (int rho psi_i)^2, the effective mass of the mode when the frame accelerates along x,
  /// y, z.
  Eigen::MatrixX3d effective_mass_kg;
  /// (m, 3): (int rho ~s0 psi)_i^2, the effective moment of inertia about the axes of the body
  /// frame.
  Eigen::MatrixX3d effective_inertia_kg_m2;
  /// (m, 6): cumulative sums up to this mode, per cent of the mass (3) and of the moments of
  /// inertia about the frame's axes (3). Fixed nodes keep the total a little below 100.
  Eigen::MatrixXd inertia_percent;

  /// Cumulative share of an interface's static compliance up to each mode: translation under a
  /// force (3) and rotation under a moment (3) along the same axis.
  struct Captured {
    std::string interface;
    Eigen::MatrixXd percent;  ///< (m, 6)
  };
  std::vector<Captured> compliance;  ///< for interfaces whose static response is known
};

BasisTable basis_table(const ModalBody& body);

/// True if the modes' shares of the kinetic energy are known (ModeRecord): only bodies of several
/// parts, the rigid ones named, have them.
bool has_shares(const ModalBody& body);

}  // namespace flexneck::fe_modal
