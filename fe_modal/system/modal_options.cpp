// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/system/modal_options.h"

namespace flexneck::fe_modal {

DofMap dof_map_of(const mesher::Mesh& mesh, const ModalOptions& options) {
  std::vector<RigidCoupling> couplings;
  for (const InterfaceDefinition& interface : options.interfaces) {
    if (!interface.is_rigid) continue;
    couplings.push_back({interface.name, mesher::nodes_of(mesh.face_set(interface.set)).nodes,
                         interface.position_m});
  }
  std::vector<FixedDirections> directions;
  for (const auto& [set, is_fixed] : options.fixed_directions) {
    directions.push_back({mesh.node_set(set).nodes, is_fixed});
  }
  return {mesh,
          options.fixed_set.empty() ? std::vector<std::int32_t>{}
                                    : mesh.node_set(options.fixed_set).nodes,
          couplings, directions};
}

std::string boundary_of(const ModalOptions& options) {
  std::string fixed = options.fixed_set;
  for (const auto& [set, directions] : options.fixed_directions) {
    if (!fixed.empty()) fixed += ", ";
    for (std::size_t a = 0; a < 3; ++a) {
      if (directions[a]) fixed += "xyz"[a];
    }
    fixed += " of " + set;
  }
  return fixed.empty() ? "free" : "fixed: " + fixed;
}

}  // namespace flexneck::fe_modal
