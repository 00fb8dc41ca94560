// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "fe_modal/algebra/block_product.h"
#include "fe_modal/algebra/eigen_pairs.h"

namespace flexneck::fe_modal {

struct DavidsonResult {
  EigenPairs pairs;
  int iterations = 0;  ///< each applies the preconditioner to one block
};

/// The lowest `count` eigenpairs of K x = lambda M x by a block Davidson method with thick restart
/// (Sleijpen and van der Vorst, SIAM J. Matrix Anal. Appl. 17 (1996) 401; the correction is the
/// preconditioned residual). All copies of a multiple eigenvalue come together, for the start is a
/// block wider than `count`.
/// @param preconditioner symmetric positive definite, near K^-1
/// @throws ComputationError if it does not converge.
DavidsonResult block_davidson(const Ranks& ranks, const BlockOperator& stiffness, Mat mass,
                              const BlockOperator& preconditioner, Eigen::Index count);

}  // namespace flexneck::fe_modal
