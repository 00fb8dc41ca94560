// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/exchange/exported_matrices.h"

#include "fe_modal/system/assembly.h"
#include "mesher/mesh/positions.h"

namespace flexneck::fe_modal {
namespace {

UpperMatrix upper_of(SymmetricMatrix& matrix) {
  return Eigen::Map<const UpperMatrix>(
      matrix.size(), matrix.size(), static_cast<Eigen::Index>(matrix.columns().size()),
      matrix.offsets().data(), matrix.columns().data(), matrix.values().data());
}

}  // namespace

ImportedBody export_matrices(const mesher::Mesh& mesh, const DofMap& dof_map,
                             const FormulationChoice& formulation) {
  SystemMatrices system = assemble(mesh, dof_map, formulation);
  ImportedBody body{upper_of(system.stiffness),
                    system.constrained_mass ? upper_of(*system.constrained_mass)
                                            : expand_mass(system.mass.between_nodes()),
                    {}};
  body.nodes_m.resize(3, dof_map.free_count());
  const auto positions = mesher::positions_of(mesh);
  // From the last one on, so that the first of tied nodes stands.
  for (auto node = static_cast<std::int32_t>(dof_map.node_count()); node-- > 0;) {
    if (dof_map.index(node) < 0) continue;
    body.nodes_m.col(dof_map.index(node)) = positions.col(node);
  }
  return body;
}

}  // namespace flexneck::fe_modal
