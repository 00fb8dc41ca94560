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

using Moved = std::vector<std::array<bool, 3>>;

/// Moves the fixed directions of a load's nodes.
void move(const mesher::Mesh& mesh, const Moved& fixed, const SupportLoad& load,
          Eigen::Matrix3Xd& displacements_m, Moved& moved) {
  const auto nodes_m = mesher::positions_of(mesh);
  bool has_moved = load.translation_m.norm() == 0 && load.rotation_rad.norm() == 0;
  for (const std::int32_t node : mesh.node_set(load.set).nodes) {
    const auto k = static_cast<std::size_t>(node);
    if (fixed[k] == std::array<bool, 3>{})
      throw InputError("node set '" + load.set +
                       "' has nodes that are not fixed: name it in modes.fixed or "
                       "modes.fixed_directions");
    const Eigen::Vector3d motion =
        load.translation_m + load.rotation_rad.cross(nodes_m.col(node) - load.position_m);
    for (std::size_t a = 0; a < 3; ++a) {
      const auto b = static_cast<Eigen::Index>(a);
      if (!fixed[k][a]) {
        if (load.translation_m[b] == 0) continue;
        throw InputError("node set '" + load.set + "' is not fixed in " + "xyz"[a] +
                         ", but is to move in it: fix it, or leave that direction out");
      }
      if (moved[k][a] && displacements_m(b, node) != motion[b])
        throw InputError("node set '" + load.set +
                         "' has nodes that another load moves by another displacement");
      moved[k][a] = true;
      displacements_m(b, node) = motion[b];
      has_moved = has_moved || motion[b] != 0;
    }
  }
  if (!has_moved)
    throw InputError("node set '" + load.set +
                     "' is not fixed in any direction in which it is to move");
}

}  // namespace

std::vector<std::array<bool, 3>> fixed_directions_of(const mesher::Mesh& mesh,
                                                     const ModalOptions& options) {
  std::vector<std::array<bool, 3>> fixed(mesh.nodes.size());
  const auto fix = [&](const std::string& set, const std::array<bool, 3>& directions) {
    for (const std::int32_t node : mesh.node_set(set).nodes) {
      auto& of_node = fixed[static_cast<std::size_t>(node)];
      for (std::size_t a = 0; a < 3; ++a) of_node[a] = of_node[a] || directions[a];
    }
  };
  if (!options.fixed_set.empty()) fix(options.fixed_set, {true, true, true});
  for (const auto& [set, directions] : options.fixed_directions) fix(set, directions);
  for_tied_pairs(mesh, [&](std::int32_t lower, std::int32_t upper) {
    auto& one = fixed[static_cast<std::size_t>(lower)];
    auto& other = fixed[static_cast<std::size_t>(upper)];
    if (one == other) return false;
    for (std::size_t a = 0; a < 3; ++a) one[a] = other[a] = one[a] || other[a];
    return true;
  });
  return fixed;
}

Eigen::Matrix3Xd support_displacements(const mesher::Mesh& mesh, const ModalOptions& options,
                                       const std::vector<Load>& loads) {
  Eigen::Matrix3Xd displacements_m =
      Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(mesh.nodes.size()));
  Moved moved(mesh.nodes.size());
  const Moved fixed = fixed_directions_of(mesh, options);
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
  return displacements_m;
}

}  // namespace flexneck::fe_modal
