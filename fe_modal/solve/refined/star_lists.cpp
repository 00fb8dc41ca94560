// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/refined/star_lists.h"

#include <algorithm>
#include <map>
#include <utility>

#include <Eigen/Core>

#include "mesher/mesh/shape_functions.h"

namespace flexneck::fe_modal {
namespace {

/// For each node of a kind the corners whose stars it belongs to: those of the edge, the face or
/// the element that it lies within.
std::vector<std::vector<std::size_t>> corners_of_nodes(mesher::ElementKind kind) {
  const auto nodes = mesher::reference_nodes(kind);
  Eigen::Matrix3Xd positions(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    positions.col(static_cast<Eigen::Index>(i)) = Eigen::Vector3d(nodes[i].data());
  }
  const mesher::ElementKind linear = mesher::linear_kind_of(mesher::shape_of(kind));
  const Eigen::MatrixXd values = mesher::tabulate(linear, positions).values;
  constexpr double kNothing = 1e-9;
  std::vector<std::vector<std::size_t>> corners(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (Eigen::Index c = 0; c < values.rows(); ++c) {
      if (values(c, static_cast<Eigen::Index>(i)) > kNothing) {
        corners[i].push_back(static_cast<std::size_t>(c));
      }
    }
  }
  return corners;
}

}  // namespace

PatchLists find_stars(const StarMesh& body) {
  const DofMap& dof_map = body.dof_map;
  // Tied corners have one star.
  const auto star_of = [&](std::int32_t corner) {
    const std::int32_t block = dof_map.index(corner);
    return block >= 0 ? block : static_cast<std::int32_t>(dof_map.free_count()) + corner;
  };
  const auto is_center = [&](std::int32_t corner) {
    return body.is_center.empty() || body.is_center[static_cast<std::size_t>(corner)];
  };
  PatchLists stars(static_cast<std::size_t>(dof_map.free_count() + dof_map.node_count()));
  for (const mesher::ElementBlock& block : body.mesh.blocks) {
    const auto corners = corners_of_nodes(block.kind);
    for (std::size_t first = 0; first < block.nodes.size(); first += corners.size()) {
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::int32_t own = dof_map.index(block.nodes[first + i]);
        if (own < 0) continue;
        for (const std::size_t c : corners[i]) {
          const std::int32_t corner = block.nodes[first + c];
          if (is_center(corner)) stars[static_cast<std::size_t>(star_of(corner))].push_back(own);
        }
      }
    }
  }
  std::erase_if(stars, [](const auto& blocks) { return blocks.empty(); });
  for (auto& blocks : stars) {
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    blocks.shrink_to_fit();
  }
  return stars;
}

bool has_inner_node(mesher::ElementKind kind) {
  const auto corners = corners_of_nodes(kind);
  return std::any_of(corners.begin(), corners.end(), [&](const auto& of_node) {
    return of_node.size() == mesher::corners_per_element(kind);
  });
}

std::vector<std::size_t> find_cells(const StarMesh& body, const PatchLists& stars) {
  constexpr std::int32_t kNone = -1;
  constexpr std::int32_t kSeveral = -2;
  std::vector<std::int32_t> parent_of(static_cast<std::size_t>(body.dof_map.free_count()), kNone);
  std::size_t element = 0;
  for (const mesher::ElementBlock& block : body.mesh.blocks) {
    const std::size_t width = mesher::nodes_per_element(block.kind);
    const bool has_cells = has_inner_node(block.kind);
    for (std::size_t k = 0; k < block.nodes.size(); ++k) {
      const std::int32_t parent = has_cells ? body.parents[element + k / width] : kSeveral;
      body.dof_map.for_each_number(block.nodes[k], [&](std::int32_t number) {
        std::int32_t& known = parent_of[static_cast<std::size_t>(number)];
        known = known == kNone || known == parent ? parent : kSeveral;
      });
    }
    element += block.size();
  }
  std::map<std::int32_t, std::size_t> cells;
  for (std::size_t s = 0; s < stars.size(); ++s) {
    const std::int32_t parent = parent_of[static_cast<std::size_t>(stars[s].front())];
    if (parent < 0 || !std::all_of(stars[s].begin(), stars[s].end(), [&](std::int32_t block) {
          return parent_of[static_cast<std::size_t>(block)] == parent;
        })) {
      continue;
    }
    const auto [place, is_new] = cells.try_emplace(parent, s);
    if (!is_new && stars[s].size() > stars[place->second].size()) place->second = s;
  }
  std::vector<std::size_t> numbers;
  numbers.reserve(cells.size());
  for (const auto& [parent, star] : cells) numbers.push_back(star);
  return numbers;
}

}  // namespace flexneck::fe_modal
