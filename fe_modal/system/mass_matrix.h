// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "fe_modal/algebra/nodal_mass.h"
#include "fe_modal/algebra/operator_matrix.h"
#include "fe_modal/dofs/node_graph.h"

namespace flexneck::fe_modal {

/// The mass of the free degrees of freedom as an operator for PETSc. A third of the entries of the
/// matrix itself: one for each pair of nodes, which serves three directions.
class MassMatrix {
 public:
  /// @param all_nodes mass of all nodes of the mesh
  /// @param graph of the free nodes
  MassMatrix(const NodalMass& all_nodes, const NodeGraph& graph, const DofMap& dof_map);

  Mat get() const { return operator_.get(); }
  /// Between the free nodes, by their indices; tied nodes are one.
  const NodalMass& between_nodes() const { return *nodal_; }

 private:
  std::unique_ptr<const NodalMass> nodal_;  ///< at a fixed address: the operator points to it
  OperatorMatrix operator_;
};

/// Matrix of zeros with the sparsity of the graph.
NodalMass zero_nodal_mass(const NodeGraph& graph);

}  // namespace flexneck::fe_modal
