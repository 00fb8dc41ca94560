// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/body/modal_body.h"

namespace flexneck::fe_modal {

/// What each vector of a basis carries of the body's inertia and of its interfaces' compliance:
/// whether there are modes enough.
struct BasisTable {
  /// (m, 3): (int rho psi_i)^2, the mass that moves with the mode when the frame accelerates along
  /// x, y, z.
  Eigen::MatrixX3d effective_mass_kg;
  /// (m, 3): (int rho ~s0 psi)_i^2, the same about the axes of the body frame.
  Eigen::MatrixX3d effective_inertia_kg_m2;
  /// (m, 6): sums over this and all modes before it, per cent of the mass (3) and of the inertia
  /// about the frame's axes (3). Fixed nodes keep the whole a little below 100.
  Eigen::MatrixXd inertia_percent;

  /// Of an interface's static compliance, translation under a force (3) and rotation under a
  /// moment (3) along the same axis, what this and all modes before it have.
  struct Captured {
    std::string interface;
    Eigen::MatrixXd percent;  ///< (m, 6)
  };
  std::vector<Captured> compliance;  ///< of interfaces whose static response is known
};

BasisTable basis_table(const ModalBody& body);

/// Whether the modes' shares of the kinetic energy are known (ModeRecord): only bodies of several
/// parts, the rigid ones named, have them.
bool has_shares(const ModalBody& body);

}  // namespace flexneck::fe_modal
