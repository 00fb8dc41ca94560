// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/algebra/petsc_handles.h"
#include "fe_modal/system/rigid_average.h"

namespace flexneck::fe_modal {

/// M + C^T M_rigid C as a matrix of PETSc's (MATLRC): the body with a rigid one that follows the
/// average motion C of a region. Good for products alone: its entries would fill the region.
class AttachedMass {
 public:
  /// @param mass of the free degrees of freedom; must outlive this
  /// @param loads C^T, (own dofs, 6): unit forces and moments on the region
  /// @param rigid_mass about the point that they act at
  AttachedMass(const Ranks& ranks, Mat mass, const Eigen::MatrixXd& loads,
               const Matrix6d& rigid_mass);

  Mat matrix() const { return sum_.get(); }

 private:
  Eigen::MatrixXd principal_loads_;  ///< in which the rigid mass is diagonal
  MatHandle columns_;                ///< lies on them
  VecHandle diagonal_;
  MatHandle sum_;
};

}  // namespace flexneck::fe_modal
