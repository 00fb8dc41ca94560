// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <Eigen/Core>

#include "fe_modal/algebra/block_product.h"
#include "fe_modal/algebra/eigen_pairs.h"

namespace flexneck::fe_modal {

/// When to stop.
struct DavidsonLimits {
  /// Of r^T P r / lambda of the residual r and the preconditioner P, which estimates the relative
  /// error of lambda if P is near K^-1; that of shapes is its root.
  double tolerance;
  int max_iterations;
};

struct DavidsonResult {
  EigenPairs pairs;
  int iterations = 0;  ///< each applies the preconditioner to one block
};

/// The lowest `count` eigenpairs of K x = lambda M x by a block Davidson method with thick restart
/// (Sleijpen and van der Vorst, SIAM J. Matrix Anal. Appl. 17 (1996) 401; the correction is the
/// preconditioned residual). All copies of a multiple eigenvalue come together, for the start is a
/// block wider than `count`.
/// @param preconditioner symmetric positive definite, near K^-1
/// @return nothing if so many iterations do not settle them
std::optional<DavidsonResult> block_davidson(const Ranks& ranks, const BlockOperator& stiffness,
                                             Mat mass, const BlockOperator& preconditioner,
                                             Eigen::Index count, const DavidsonLimits& limits);

}  // namespace flexneck::fe_modal
