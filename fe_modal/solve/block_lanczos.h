// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <Eigen/Core>

#include "fe_modal/algebra/eigen_pairs.h"
#include "fe_modal/algebra/petsc_handles.h"
#include "fe_modal/algebra/shift_inverse.h"

namespace flexneck::fe_modal {

/// What is known of the wanted pairs after a block.
struct RitzState {
  Eigen::VectorXd before;     ///< values one block earlier, (count); empty if there were fewer
  Eigen::VectorXd values;     ///< lambda, (count), ascending, each an upper bound
  Eigen::VectorXd residuals;  ///< ||(K - shift M)^-1 M x - theta x||_M / theta, (count)
};
/// Tells whether to stop.
using Settled = std::function<bool(const RitzState&)>;

/// The lowest eigenpairs of K x = lambda M x by the block Lanczos method on (K - shift M)^-1 M,
/// orthogonalised in full and with thick restart (Grimes, Lewis and Simon, SIAM J. Matrix Anal.
/// Appl. 15 (1994) 228; Wu and Simon, ibid. 22 (2000) 602). A block is solved for at once: the
/// factor is read once for all of its columns, where one vector at a time waits for the memory.
/// Copies of a multiple eigenvalue come together if the start has as many columns.
/// @param mass may differ from that in the inverse if the shift is zero
/// @param start (own dofs, block); what depends on other columns is dropped
/// @return `count` pairs, or fewer if all that was given spans no more
/// @throws ComputationError if they do not settle.
EigenPairs block_lanczos(Mat mass, const ShiftInverse& inverse, Eigen::MatrixXd start,
                         Eigen::Index count, const Settled& settled);

/// One inverse iteration of all pairs, with the Ritz method: it divides the rounding in the shapes
/// by the squares of their frequencies, which a small residual needs.
EigenPairs purified(Mat mass, const ShiftInverse& inverse, const EigenPairs& pairs);

}  // namespace flexneck::fe_modal
