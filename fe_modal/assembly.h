// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>

#include "fe_modal/element_matrices.h"
#include "fe_modal/free_nodes.h"
#include "fe_modal/petsc_handles.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Consistent mass between nodes, (n, n), kg: the same in each direction. Holds for all nodes.
using NodalMass = Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t>;

/// Matrices of the whole body.
struct SystemMatrices {
  MatHandle stiffness;   ///< of the free degrees of freedom, N/m; the upper half is stored
  MatHandle mass;        ///< of the free degrees of freedom, kg; the upper half is stored
  NodalMass nodal_mass;  ///< of all nodes
};

/// @throws ComputationError if PETSc fails, e.g. for want of memory.
SystemMatrices assemble(const mesher::Mesh& mesh, const FreeNodes& free_nodes,
                        Formulation formulation = Formulation::mixed_pressure);

}  // namespace flexneck::fe_modal
