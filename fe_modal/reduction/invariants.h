// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "fe_modal/body/modal_body.h"
#include "fe_modal/reduction/particles.h"
#include "fe_modal/system/assembly.h"

namespace flexneck::fe_modal {

using MassIntegrals = std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>;

/// Inertia invariants from the consistent mass matrix (equations.md, section 2): each is a sum of
/// integrals int rho p q = p^T M q of the component fields p, q in {1, s0, psi}. For isoparametric
/// elements p^T M q is the integral itself, by the quadrature of the mass matrix.
/// @param mass_integrals int rho f g dV of all pairs of fields, (n, k) -> (k, k)
/// @param nodes_m positions in the body frame
/// @param shapes m fields on all nodes, (3, n) each
/// @param particles point masses of the body, with their motions in the m fields
InertiaInvariants inertia_invariants(const MassIntegrals& mass_integrals,
                                     const std::vector<std::array<double, 3>>& nodes_m,
                                     const std::vector<Eigen::Matrix3Xd>& shapes,
                                     const std::vector<Particle>& particles = {});
/// Inertia invariants from a mass matrix between all nodes.
InertiaInvariants inertia_invariants(const NodalMass& mass,
                                     const std::vector<std::array<double, 3>>& nodes_m,
                                     const std::vector<Eigen::Matrix3Xd>& shapes);

}  // namespace flexneck::fe_modal
