// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/body/modal_body.h"

namespace flexneck::fe_modal {

/// Largest accepted |Maa - I| and |tr G / 2 - Maa|.
inline constexpr double kMassNormalised = 1e-6;

/// Rounding error of sums of n products of double precision, as the invariants are, relative to the
/// largest value that they can have by the inequality of Schwarz. A consistent mass couples a node
/// with up to about a hundred others, and either side of an identity rounds.
double rounding_of_sums(Eigen::Index n);

/// Checks the identities among the inertia invariants of a body, as sums of products over the same
/// masses:
///   J0 = J0^T, Maa = I = (tr G_jl / 2), G_jl = G_lj^T, N_jl = -N_lj
///   N0_l and N_jl have the antisymmetric parts of G0_l and G_jl
///   The integrals int rho p q of the fields 1, s0 and psi follow from m, S1, S2, J0, G0 and G.
///   Their matrix is positive semidefinite. This implies the parallel axis theorem, the triangle
///   inequality of moments of inertia, effective masses that are not above the mass, and a mass
///   matrix that is positive semidefinite for any deformation.
/// @param rounding rounding_of_sums()
/// @throws InputError "<dataset>: …" with the entry, by how much it is off, and what is allowed.
void check_invariants(const InertiaInvariants& inertia, double rounding);

}  // namespace flexneck::fe_modal
