// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <Eigen/Core>

#include "fe_modal/dofs/dof_map.h"

namespace flexneck::fe_modal {

/// Rigid motions of a body as a whole that its constraints and springs permit: six of a free body,
/// none of a fixed one, three of the half of a body on a plane of symmetry.
class RigidMotions {
 public:
  /// @param connections as in the DofMap
  RigidMotions(const mesher::Mesh& mesh, const mesher::Connections& connections,
               const DofMap& dof_map);

  Eigen::Index count() const { return motions_.cols(); }
  /// The motions as free values, (dofs, count), independent.
  /// @param dof_map map of the same constraints, in any numbering
  Eigen::MatrixXd vectors(const mesher::Mesh& mesh, const mesher::Connections& connections,
                          const DofMap& dof_map) const;
  /// Text "slides along x and y, rotates about z"; for a rotation about no stationary point, it
  /// includes the translation along the axis; empty if there are no motions.
  std::string text() const;

 private:
  /// (6, count) translation of the body's centre, m, and rotation, times `length_m`, orthonormal.
  Eigen::Matrix<double, 6, Eigen::Dynamic> motions_;
};

}  // namespace flexneck::fe_modal
