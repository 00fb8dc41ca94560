// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include <Eigen/Core>

#include "fe_modal/algebra/operator_matrix.h"

namespace flexneck::fe_modal {

/// Operator P^T M P, with P the K-orthogonal projector to the fields on which C x = 0: P = I - X (C
/// X)^-1 C with K X = C^T. The eigenpairs of K x = lambda P^T M P x with finite lambda are the
/// modes of the body whose interfaces' average motions C x are fixed: K^-1 P^T = P K^-1 is
/// symmetric, so that x = lambda P K^-1 M P x has C x = 0.
class ConstrainedMass {
 public:
  /// @param mass mass matrix of the free degrees of freedom; must outlive this
  /// @param constraints C^T, (dofs, n), independent
  /// @param responses X, (dofs, n)
  ConstrainedMass(const Ranks& ranks, Mat mass, const Eigen::MatrixXd& constraints,
                  const Eigen::MatrixXd& responses);

  Mat matrix() const { return operator_.get(); }
  /// Projection P x of each column.
  Eigen::MatrixXd project(const Eigen::MatrixXd& columns) const;

 private:
  struct Terms;
  std::shared_ptr<const Terms> terms_;
  OperatorMatrix operator_;
};

}  // namespace flexneck::fe_modal
