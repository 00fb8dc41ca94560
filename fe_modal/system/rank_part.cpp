// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/system/rank_part.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "fe_modal/dofs/point_element.h"

namespace flexneck::fe_modal {
namespace {

/// Springs and point masses of a part, on its sites; the reference points are all there.
class PartConnections {
 public:
  PartConnections(const mesher::Mesh& whole, const std::vector<std::int32_t>& numbers,
                  std::int32_t number)
      : whole_(whole) {
    std::size_t next =
        numbers.size() - whole.connections.springs.size() - whole.connections.masses.size();
    result_.points = whole.connections.points;
    for (const mesher::Spring& spring : whole.connections.springs) {
      if (numbers[next++] != number) continue;
      result_.springs.push_back(spring);
      for (const mesher::Term& term : spring.terms) sites_.push_back(term.site);
    }
    for (const mesher::PointMass& mass : whole.connections.masses) {
      if (numbers[next++] != number) continue;
      result_.masses.push_back(mass);
      sites_.push_back(mass.site);
      if (!is_node(mass.site)) sites_.push_back(mass.site + 1);
    }
  }

  /// In the whole.
  const std::vector<std::int32_t>& sites() const { return sites_; }
  std::vector<std::int32_t> nodes() const {
    std::vector<std::int32_t> nodes;
    for (const std::int32_t site : sites_) {
      if (is_node(site)) nodes.push_back(site);
    }
    return nodes;
  }

  /// @param nodes of the part, ascending
  mesher::Connections on(const std::vector<std::int32_t>& nodes) && {
    const auto renumber = [&](std::int32_t& site) {
      const auto place = std::lower_bound(nodes.begin(), nodes.end(), site) - nodes.begin();
      site = static_cast<std::int32_t>(
          is_node(site) ? place
                        : site - static_cast<std::ptrdiff_t>(whole_.nodes.size()) +
                              static_cast<std::ptrdiff_t>(nodes.size()));
    };
    for (mesher::Spring& spring : result_.springs) {
      for (mesher::Term& term : spring.terms) renumber(term.site);
    }
    for (mesher::PointMass& mass : result_.masses) renumber(mass.site);
    return std::move(result_);
  }

 private:
  bool is_node(std::int32_t site) const {
    return static_cast<std::size_t>(site) < whole_.nodes.size();
  }

  const mesher::Mesh& whole_;
  mesher::Connections result_;
  std::vector<std::int32_t> sites_;
};

/// Nodes that only springs and masses bring belong to the part too.
void add_nodes(const mesher::Mesh& whole, std::vector<std::int32_t> more,
               mesher::MeshPiece& piece) {
  std::vector<std::int32_t> nodes = piece.nodes;
  nodes.insert(nodes.end(), more.begin(), more.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  if (nodes.size() == piece.nodes.size()) return;
  std::vector<std::int32_t> place;
  for (const std::int32_t node : piece.nodes) {
    place.push_back(static_cast<std::int32_t>(std::lower_bound(nodes.begin(), nodes.end(), node) -
                                              nodes.begin()));
  }
  for (mesher::ElementBlock& block : piece.mesh.blocks) {
    for (std::int32_t& node : block.nodes) node = place[static_cast<std::size_t>(node)];
  }
  piece.mesh.nodes.clear();
  for (const std::int32_t node : nodes) {
    piece.mesh.nodes.push_back(whole.nodes[static_cast<std::size_t>(node)]);
  }
  piece.nodes = std::move(nodes);
}

}  // namespace

RankPart::RankPart(const mesher::Mesh& mesh, const DofMap& dof_map)
    : whole_(mesh),
      whole_dof_map_(dof_map),
      blocks_(static_cast<std::size_t>(dof_map.free_count())) {
  std::iota(blocks_.begin(), blocks_.end(), 0);
}

RankPart::RankPart(const mesher::Mesh& mesh, const DofMap& dof_map,
                   const std::vector<std::int32_t>& numbers, std::int32_t number)
    : whole_(mesh), whole_dof_map_(dof_map), piece_(mesher::submesh(mesh, numbers, number)) {
  PartConnections connections(mesh, numbers, number);
  add_nodes(mesh, connections.nodes(), *piece_);
  dof_map_ = dof_map.part(piece_->nodes, connections.sites(), blocks_);
  piece_->mesh.connections = std::move(connections).on(piece_->nodes);
}

void RankPart::renumber(std::span<const std::int32_t> order) {
  dof_map_->renumber(order);
  std::vector<std::int32_t> blocks;
  blocks.reserve(order.size());
  for (const std::int32_t block : order) blocks.push_back(blocks_[static_cast<std::size_t>(block)]);
  blocks_ = std::move(blocks);
}

Eigen::MatrixXd RankPart::rows_of_nodes(const Eigen::MatrixXd& all) const {
  if (!piece_) return all;
  return all(piece_->nodes, Eigen::all);
}

Eigen::Matrix3Xd RankPart::columns_of_nodes(const Eigen::Matrix3Xd& all) const {
  if (!piece_ || all.cols() == 0) return all;
  return all(Eigen::all, piece_->nodes);
}

std::size_t element_count(const mesher::Mesh& mesh) {
  std::size_t count = mesh.connections.springs.size() + mesh.connections.masses.size();
  for (const mesher::ElementBlock& block : mesh.blocks) count += block.size();
  return count;
}

void for_each_element(
    const mesher::Mesh& mesh,
    const std::function<void(std::size_t, std::span<const std::int32_t>)>& visit) {
  std::size_t element = 0;
  for (const mesher::ElementBlock& block : mesh.blocks) {
    const std::size_t width = mesher::nodes_per_element(block.kind);
    for (std::size_t first = 0; first < block.nodes.size(); first += width) {
      visit(element++, std::span(block.nodes).subspan(first, width));
    }
  }
  for (const PointElement& point : point_elements_of(mesh.connections, mesh.nodes.size())) {
    visit(element++, point.sites);
  }
}

DofLayout layout_of(const Ranks& ranks, const mesher::Mesh& mesh, const DofMap& dof_map,
                    const std::vector<std::int32_t>& rank_of_element) {
  if (!ranks.are_many()) return DofLayout(dof_map.free_count(), ranks);
  std::vector<std::int32_t> owners(static_cast<std::size_t>(dof_map.free_count()), ranks.count());
  for_each_element(mesh, [&](std::size_t element, std::span<const std::int32_t> nodes) {
    for (const std::int32_t node : nodes) {
      dof_map.for_each_number(node, [&](std::int32_t block) {
        std::int32_t& owner = owners[static_cast<std::size_t>(block)];
        owner = std::min(owner, rank_of_element[element]);
      });
    }
  });
  // What no element has is of the first rank.
  std::replace(owners.begin(), owners.end(), ranks.count(), 0);
  return {ranks, std::move(owners)};
}

}  // namespace flexneck::fe_modal
