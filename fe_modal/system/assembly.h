// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <Eigen/Core>

#include "fe_modal/algebra/symmetric_matrix.h"
#include "fe_modal/dofs/dof_map.h"
#include "fe_modal/dofs/node_graph.h"
#include "fe_modal/element/formulation.h"
#include "fe_modal/system/mass_matrix.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Matrices of the whole body.
struct SystemMatrices {
  NodeGraph graph;            ///< of the blocks of degrees of freedom
  SymmetricMatrix stiffness;  ///< of the free degrees of freedom, N/m
  NodalMass nodal_mass;       ///< of all nodes, kg; without point masses
  MassMatrix mass;            ///< of the free degrees of freedom, kg; void with constraints
  /// Where constraints join degrees of freedom, and where there are point masses or springs: of the
  /// free degrees of freedom; zero in dependent ones.
  std::optional<SymmetricMatrix> constrained_mass;

  Mat mass_operator() const { return constrained_mass ? constrained_mass->get() : mass.get(); }
};

/// @param prestress_m displacements of all nodes, (3, n), whose stresses add their geometric
/// stiffness; without columns: none
/// @throws InputError if a part's kind of element has no such formulation.
/// @throws ComputationError if an element is inverted, or PETSc fails, e.g. for want of memory.
SystemMatrices assemble(const mesher::Mesh& mesh, const DofMap& dof_map,
                        const FormulationChoice& formulation = {},
                        const Eigen::Matrix3Xd& prestress_m = Eigen::Matrix3Xd());

/// Geometric stiffness alone, N/m, of the stresses of a displacement field: as the difference of
/// two stiffnesses it would have their rounding errors, which in a slender body are large beside
/// it.
/// @param prestress_m displacements of all nodes, (3, n)
SymmetricMatrix assemble_geometric(const mesher::Mesh& mesh, const DofMap& dof_map,
                                   const FormulationChoice& formulation,
                                   const Eigen::Matrix3Xd& prestress_m);

/// K - shift M.
SymmetricMatrix shifted_stiffness(const SystemMatrices& system, double shift);

}  // namespace flexneck::fe_modal
