// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "fe_modal/free_nodes.h"
#include "fe_modal/petsc_handles.h"
#include "fe_modal/rigid_average.h"

namespace flexneck::fe_modal {

/// Mass matrix of a rigid body about a point, (6, 6): translation of the point, then rotation.
/// @param center_m of mass, from the point
/// @param inertia_kg_m2 about the centre of mass
Matrix6d rigid_mass_matrix(double mass_kg, const Eigen::Vector3d& center_m,
                           const Eigen::Matrix3d& inertia_kg_m2);

/// M + C^T M_rigid C as an operator: the body with a rigid one that follows the average motion C of
/// a region. The matrix itself would be full on the region.
class AttachedMass {
 public:
  /// @param mass of the free degrees of freedom; must outlive this
  AttachedMass(Mat mass, const FreeNodes& free_nodes, const RigidAverage& region,
               const Matrix6d& rigid_mass);

  Mat matrix() const { return shell_.get(); }

 private:
  struct Terms;
  std::shared_ptr<const Terms> terms_;  ///< at a fixed address: the shell points to it
  MatHandle shell_;
};

}  // namespace flexneck::fe_modal
