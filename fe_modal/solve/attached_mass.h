// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/algebra/petsc_handles.h"
#include "fe_modal/system/rigid_average.h"

namespace flexneck::fe_modal {

/// Matrix M + C^T M_rigid C of PETSc's type MATLRC: the body with a rigid body that follows the
/// average motion C of a region. It supports products alone: its entries would fill the rows of the
/// region.
class AttachedMass {
 public:
  /// @param mass mass matrix of the free degrees of freedom; must outlive this
  /// @param loads C^T, (own dofs, 6): unit forces and moments on the region
  /// @param rigid_mass mass matrix about the point of application of the loads
  AttachedMass(const Ranks& ranks, Mat mass, const Eigen::MatrixXd& loads,
               const Matrix6d& rigid_mass);

  Mat matrix() const { return sum_.get(); }

 private:
  Eigen::MatrixXd principal_loads_;  ///< loads in axes in which the rigid mass is diagonal
  MatHandle columns_;                ///< wraps the loads in place
  VecHandle diagonal_;
  MatHandle sum_;
};

}  // namespace flexneck::fe_modal
