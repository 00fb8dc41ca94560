// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/algebra/operator_matrix.h"
#include "fe_modal/algebra/shift_inverse.h"
#include "fe_modal/dofs/rigid_mass.h"
#include "fe_modal/system/rigid_average.h"

namespace flexneck::fe_modal {

/// M + C^T M_rigid C as an operator: the body with a rigid one that follows the average motion C of
/// a region. The matrix itself would be full on the region.
class AttachedMass {
 public:
  /// @param mass of the free degrees of freedom; must outlive this
  /// @param loads C^T, (dofs, 6): unit forces and moments on the region; must outlive this
  /// @param rigid_mass about the point that they act at
  AttachedMass(const Ranks& ranks, Mat mass, const Eigen::MatrixXd& loads,
               const Matrix6d& rigid_mass);

  Mat matrix() const { return operator_.get(); }
  const Eigen::MatrixXd& loads() const { return loads_; }

 private:
  const Eigen::MatrixXd& loads_;
  OperatorMatrix operator_;
};

/// The lowest eigenpairs of K x = lambda (M + C^T M_rigid C) x by inverse iteration of the span of
/// the body's lowest modes and of its static response to the loads on the region. A mode that is
/// orthogonal to these in the energy does not move the region, so it is one of the body without
/// the mass, and none of its lowest: nothing can be missed that is asked for.
/// @param inverse of K
/// @param modes (dofs, m) the body's lowest; m is at least `count`
/// @return whose values are converged, and whose vectors are as good as that takes
EigenPairs lowest_eigenpairs(const AttachedMass& mass, const ShiftInverse& inverse,
                             const Eigen::Ref<const Eigen::MatrixXd>& modes, Eigen::Index count);

/// The vectors of such pairs, converged too: what is made of them may be linear in their errors.
Eigen::MatrixXd converged_vectors(const AttachedMass& mass, const ShiftInverse& inverse,
                                  const EigenPairs& pairs);

}  // namespace flexneck::fe_modal
