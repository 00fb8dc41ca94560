// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/system/supports.h"

#include <algorithm>
#include <string>

#include <Eigen/Geometry>

#include "geometry/foundation/error.h"
#include "mesher/mesh/positions.h"

namespace flexneck::fe_modal {
namespace {

/// Calls couple(lower, upper) for each pair of the tied slits until none of them changes anything:
/// where cuts cross, more than two nodes are one.
template <typename Couple>
void for_tied_pairs(const mesher::Mesh& mesh, const Couple& couple) {
  for (bool changed = true; changed;) {
    changed = false;
    for (const mesher::Slit& slit : mesh.slits) {
      if (!slit.tied) continue;
      for (std::size_t p = 0; p < slit.lower.size(); ++p)
        changed = couple(slit.lower[p], slit.upper[p]) || changed;
    }
  }
}

using Directions = std::vector<std::array<bool, 3>>;

/// Directions that supports along x, y and z fix.
Directions supported(const mesher::Mesh& mesh, const ModalOptions& options,
                     const mesher::Connections& connections) {
  Directions fixed(mesh.nodes.size());
  const auto fix = [&](const std::vector<std::int32_t>& nodes,
                       const std::array<bool, 3>& directions) {
    for (const std::int32_t node : nodes) {
      auto& of_node = fixed[static_cast<std::size_t>(node)];
      for (std::size_t a = 0; a < 3; ++a) of_node[a] = of_node[a] || directions[a];
    }
  };
  if (!options.fixed_set.empty()) fix(mesh.node_set(options.fixed_set).nodes, {true, true, true});
  for (const mesher::Support& support : connections.supports) {
    if (support.axes.is_global()) fix(support.nodes, support.directions);
  }
  return fixed;
}

/// Calls visit(node, name) for nodes that connections act on, other than supports along x, y and z.
template <typename Visitor>
void for_connected_nodes(const mesher::Connections& connections, std::size_t node_count,
                         const Visitor& visit) {
  const auto visit_terms = [&](const auto& each) {
    for (const mesher::Term& term : each.terms) {
      if (static_cast<std::size_t>(term.site) < node_count) visit(term.site, each.name);
    }
  };
  for (const mesher::Coupling& coupling : connections.couplings) {
    for (const std::int32_t node : coupling.nodes) visit(node, coupling.name);
  }
  for (const mesher::Equation& equation : connections.equations) visit_terms(equation);
  for (const mesher::Spring& spring : connections.springs) visit_terms(spring);
  for (const mesher::Support& support : connections.supports) {
    if (support.axes.is_global()) continue;
    for (const std::int32_t node : support.nodes) visit(node, support.name);
  }
}

void spread_over_ties(const mesher::Mesh& mesh, Directions& directions) {
  for_tied_pairs(mesh, [&](std::int32_t lower, std::int32_t upper) {
    auto& one = directions[static_cast<std::size_t>(lower)];
    auto& other = directions[static_cast<std::size_t>(upper)];
    if (one == other) return false;
    for (std::size_t a = 0; a < 3; ++a) one[a] = other[a] = one[a] || other[a];
    return true;
  });
}

/// Refuses connections on moving support nodes: forces in them would follow the nodes' motion.
void refuse_connected(const mesher::Connections& connections, const Directions& moved) {
  for_connected_nodes(connections, moved.size(), [&](std::int32_t node, const std::string& name) {
    if (moved[static_cast<std::size_t>(node)] == std::array<bool, 3>{}) return;
    throw InputError("supports with a displacement are not possible at nodes of " + name +
                     "; remove it, or move other nodes");
  });
}

/// Moves the fixed directions of a load's nodes.
void move(const mesher::Mesh& mesh, const Directions& fixed, const SupportLoad& load,
          Eigen::Matrix3Xd& displacements_m, Directions& moved) {
  const auto nodes_m = mesher::positions_of(mesh);
  bool has_moved = load.translation_m.norm() == 0 && load.rotation_rad.norm() == 0;
  for (const std::int32_t node : mesh.node_set(load.set).nodes) {
    const auto k = static_cast<std::size_t>(node);
    if (fixed[k] == std::array<bool, 3>{})
      throw InputError(
          "node set '" + load.set +
          "' has nodes that are not fixed; name it in modes.fixed or modes.fixed_directions");
    const Eigen::Vector3d motion =
        load.translation_m + load.rotation_rad.cross(nodes_m.col(node) - load.position_m);
    for (std::size_t a = 0; a < 3; ++a) {
      const auto b = static_cast<Eigen::Index>(a);
      if (!fixed[k][a]) {
        if (load.translation_m[b] == 0) continue;
        throw InputError(
            "node set '" + load.set + "' is not fixed in " + "xyz"[a] +
            ", but has a displacement in that direction; fix it there, or remove the displacement");
      }
      if (moved[k][a] && displacements_m(b, node) != motion[b])
        throw InputError("node set '" + load.set +
                         "' has nodes to which another load gives a different displacement");
      moved[k][a] = true;
      displacements_m(b, node) = motion[b];
      has_moved = has_moved || motion[b] != 0;
    }
  }
  if (!has_moved)
    throw InputError("node set '" + load.set +
                     "' is not fixed in any direction of its displacement");
}

}  // namespace

std::vector<std::array<bool, 3>> reacting_directions_of(const mesher::Mesh& mesh,
                                                        const ModalOptions& options) {
  const mesher::Connections connections = connections_of(mesh, options);
  Directions directions = supported(mesh, options, connections);
  for_connected_nodes(connections, mesh.nodes.size(),
                      [&](std::int32_t node, const std::string& /*name*/) {
                        directions[static_cast<std::size_t>(node)] = {true, true, true};
                      });
  spread_over_ties(mesh, directions);
  return directions;
}

Eigen::Matrix3Xd support_displacements(const mesher::Mesh& mesh, const ModalOptions& options,
                                       const std::vector<Load>& loads) {
  Eigen::Matrix3Xd displacements_m =
      Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(mesh.nodes.size()));
  Directions moved(mesh.nodes.size());
  const mesher::Connections connections = connections_of(mesh, options);
  Directions fixed = supported(mesh, options, connections);
  spread_over_ties(mesh, fixed);
  for (const Load& load : loads) {
    const auto* const support = std::get_if<SupportLoad>(&load.kind);
    if (support == nullptr) continue;
    try {
      move(mesh, fixed, *support, displacements_m, moved);
    } catch (const InputError& error) {
      throw InputError("load '" + load.name + "': " + error.what());
    }
  }
  for_tied_pairs(mesh, [&](std::int32_t lower, std::int32_t upper) {
    bool changed = false;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto b = static_cast<Eigen::Index>(a);
      bool& one = moved[static_cast<std::size_t>(lower)][a];
      bool& other = moved[static_cast<std::size_t>(upper)][a];
      if (one == other) continue;
      (one ? displacements_m(b, upper) : displacements_m(b, lower)) =
          one ? displacements_m(b, lower) : displacements_m(b, upper);
      one = other = changed = true;
    }
    return changed;
  });
  refuse_connected(connections, moved);
  return displacements_m;
}

}  // namespace flexneck::fe_modal
