// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "fe_modal/algebra/nodal_mass.h"
#include "fe_modal/algebra/petsc_handles.h"
#include "fe_modal/dofs/dof_map.h"
#include "fe_modal/element/formulation.h"
#include "fe_modal/system/model.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Matrices of a body. K and M are PETSc matrices of the free degrees of freedom, each rank with
/// its rows (DofLayout).
struct SystemMatrices {
  MatHandle stiffness;  ///< N/m, upper half (MATSBAIJ)
  MatHandle nodal;      ///< kg, between the free blocks in one direction; null with constraints
  /// kg: `nodal` in three directions (MATMAIJ); if constraints join degrees of freedom, or there
  /// are point masses or springs, an upper half like that of K, zero in dependent degrees of
  /// freedom
  MatHandle mass;
  NodalMass nodal_mass;  ///< kg, between all nodes, from this rank's elements; without point masses
};

/// Assembles the matrices of a model.
/// @throws InputError if a part's kind of element has no such formulation.
/// @throws ComputationError if an element is inverted, or PETSc fails, e.g. for lack of memory.
SystemMatrices assemble(const Model& model);
/// Assembles the matrices of a mesh on one process.
/// @param prestress_m displacements of all nodes, (3, n), whose stresses add their geometric
/// stiffness; no columns without prestress
SystemMatrices assemble(const mesher::Mesh& mesh, const DofMap& dof_map,
                        const FormulationChoice& formulation = {},
                        const Eigen::Matrix3Xd& prestress_m = Eigen::Matrix3Xd());

/// Assembles the geometric stiffness alone times a factor, N/m, for the stresses of a displacement
/// field: as the difference of two stiffnesses it would have their rounding errors, which in a
/// slender body are large beside it. On one process.
/// @param prestress_m displacements of all nodes, (3, n)
MatHandle assemble_geometric(const mesher::Mesh& mesh, const DofMap& dof_map,
                             const FormulationChoice& formulation,
                             const Eigen::Matrix3Xd& prestress_m, double factor = 1);

/// Matrix K - shift M, upper half.
MatHandle shifted_stiffness(Mat stiffness, Mat mass, double shift);

}  // namespace flexneck::fe_modal
