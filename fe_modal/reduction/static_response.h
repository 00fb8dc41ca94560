// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "fe_modal/reduction/operators.h"
#include "fe_modal/solve/eigensolver.h"

namespace flexneck::fe_modal {

/// Removes the modes' part from columns, which become M-orthogonal to the modes.
/// @param modes (dofs, m), M-orthonormal; may have no columns
/// @param momenta MX, the mass matrix times the modes
void remove_modes(const Ranks& ranks, const Eigen::MatrixXd& modes, const Eigen::MatrixXd& momenta,
                  Eigen::MatrixXd& columns);

/// Static shapes less the part of some modes: X with K X = F - M Phi Phi^T F, M-orthogonal to the
/// modes Phi. If Phi contains a free body's six rigid motions, X is its deformation under the loads
/// and the inertia forces that balance them (inertia relief). Without modes it is K^-1 F.
///
/// The solution uses the factor of K and a step of refinement; where that does not suffice, as for
/// a free body, whose factor is that of a shifted stiffness, conjugate gradients.
/// @param loads F, (dofs, n)
/// @param kept the modes, M-orthonormal eigenpairs; all rigid motions among them if the shift is
/// not zero
/// @throws ComputationError if the iteration does not converge.
Eigen::MatrixXd static_response_beyond(const BodyOperators& body, const EigenPairs& kept,
                                       const Eigen::MatrixXd& loads);

/// The modes' part of static shapes: X^T M X and F^T X of X = sum phi (phi^T F) / lambda over the
/// modes that are no rigid motion.
struct ModalResponse {
  Eigen::MatrixXd amplitudes;  ///< amplitudes of the modes, (m, n)
  Eigen::MatrixXd compliance;  ///< F^T X, (n, n)
  Eigen::MatrixXd mass;        ///< X^T M X, (n, n)
};
/// @param modal_loads Phi^T F, (m, n)
ModalResponse modal_response(const Eigen::VectorXd& values, const Eigen::MatrixXd& modal_loads);

}  // namespace flexneck::fe_modal
