// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "fe_modal/algebra/eigen_pairs.h"
#include "fe_modal/solve/refined/refined_system.h"

namespace flexneck::fe_modal {

/// What the modes of a mesh become on its refinement, as far as their changes ask.
struct RefinedModes {
  /// Upper bounds, (m), ascending.
  Eigen::VectorXd values;
  /// Estimates of how far these are above the eigenvalues, (m), at most a third of the changes.
  Eigen::VectorXd excess;
  Eigen::MatrixXd vectors;  ///< (own dofs, m), x^T M x = 1
};

/// Improves the modes of the mesh before by a block conjugate gradient method for eigenvectors
/// (Knyazev, SIAM J. Sci. Comput. 23 (2001) 517), preconditioned by the stars and the mesh before.
/// Fields of that mesh have a divergence on the refined one which its own pressures do not see, and
/// of which nearly incompressible rubber makes much energy: where elements have a middle node, each
/// step ends with exact solves within the elements of that mesh, which take it away (Schoeberl, as
/// StarPatches). Ends when the steps, continued as a geometric series, would not change any
/// eigenvalue by more than a third of its change from mesh to mesh.
/// @param coarse pairs of the mesh before
/// @param rigid_count its first pairs that are rigid motions, which no mesh changes
/// @throws ComputationError if the modes do not settle.
RefinedModes refined_modes(const RefinedSystem& system, const EigenPairs& coarse,
                           Eigen::Index rigid_count);

}  // namespace flexneck::fe_modal
