// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/system/modal_options.h"

#include <algorithm>
#include <set>

#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

std::string name_of(const InterfaceDefinition& interface) {
  return "rigid interface '" + interface.name + "'";
}

/// Refuses rigid interfaces whose nodes are fixed.
void require_motion(const mesher::Connections& connections, const ModalOptions& options,
                    const DofMap& dof_map) {
  for (const InterfaceDefinition& interface : options.interfaces) {
    if (!interface.is_rigid) continue;
    const std::string name = name_of(interface);
    for (std::size_t p = 0; p < connections.points.size(); ++p) {
      if (connections.points[p].name != name) continue;
      const std::int32_t site = mesher::translation_site(
          static_cast<std::size_t>(dof_map.node_count()), static_cast<std::int32_t>(p));
      const auto is_still = [&](std::int32_t each) {
        bool moves = false;
        dof_map.for_each_number(each, [&](std::int32_t /*block*/) { moves = true; });
        return !moves;
      };
      if (is_still(site) && is_still(site + 1))
        throw InputError(name + " has nodes that are fixed");
    }
  }
}

}  // namespace

mesher::Connections connections_of(const mesher::Mesh& mesh, const ModalOptions& options) {
  mesher::Connections connections = mesh.connections;
  for (const InterfaceDefinition& interface : options.interfaces) {
    if (!interface.is_rigid) continue;
    const Eigen::Vector3d& x = interface.position_m;
    connections.couplings.push_back({name_of(interface),
                                     static_cast<std::int32_t>(connections.points.size()),
                                     mesher::nodes_of(mesh.face_set(interface.set)).nodes});
    connections.points.push_back({name_of(interface), {x[0], x[1], x[2]}});
  }
  for (const auto& [set, directions] : options.fixed_directions) {
    connections.supports.push_back(
        {"the fixed set '" + set + "'", mesh.node_set(set).nodes, directions});
  }
  return connections;
}

DofMap dof_map_of(const mesher::Mesh& mesh, const ModalOptions& options) {
  const mesher::Connections connections = connections_of(mesh, options);
  DofMap dof_map(mesh,
                 options.fixed_set.empty() ? std::vector<std::int32_t>{}
                                           : mesh.node_set(options.fixed_set).nodes,
                 connections);
  require_motion(connections, options, dof_map);
  return dof_map;
}

RigidMotions rigid_motions_of(const mesher::Mesh& mesh, const ModalOptions& options) {
  return {mesh, connections_of(mesh, options), dof_map_of(mesh, options)};
}

std::string boundary_of(const mesher::Mesh& mesh, const ModalOptions& options,
                        const RigidMotions& rigid) {
  std::string fixed = options.fixed_set;
  const auto add = [&](const std::string& name) { fixed += (fixed.empty() ? "" : ", ") + name; };
  for (const auto& [set, directions] : options.fixed_directions) {
    std::string letters;
    for (std::size_t a = 0; a < 3; ++a) {
      if (directions[a]) letters += "xyz"[a];
    }
    add(letters + " of " + set);
  }
  std::set<std::string> others;
  const std::vector<std::int32_t> nodes = options.fixed_set.empty()
                                              ? std::vector<std::int32_t>()
                                              : mesh.node_set(options.fixed_set).nodes;
  for (const mesher::Support& support : mesh.connections.supports) {
    const std::vector<std::int32_t>& own = support.nodes;
    if (!std::includes(nodes.begin(), nodes.end(), own.begin(), own.end())) {
      others.insert(support.name);
    }
  }
  for (const mesher::Equation& equation : mesh.connections.equations) {
    if (equation.terms.size() == 1) others.insert(equation.name);
  }
  for (const std::string& name : others) add(name);
  constexpr Eigen::Index kFree = 6;
  if (fixed.empty() && rigid.count() < kFree)
    fixed = mesh.connections.springs.empty() ? "equations" : "springs";
  if (fixed.empty()) return "free";
  return "fixed: " + fixed + (rigid.count() > 0 ? "; " + rigid.text() : "");
}

}  // namespace flexneck::fe_modal
