// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>

#include <Eigen/Core>

#include "mesher/exchange/deck_connections.h"

namespace flexneck::mesher {

/// Where a deck's nodes are among the sites of a mesh. Nodes that no element uses become reference
/// points when they are asked for.
class DeckSites {
 public:
  /// @throws InputError for a node on the axis of its cylindrical axes that is held or moved along
  /// one of the two directions across; held in both or neither, it has fixed axes.
  DeckSites(const DeckConnections& deck, const DeckNodes& nodes, Mesh& mesh);

  // `who` asks, for messages. @throws InputError for nodes that the deck does not give.

  Eigen::Vector3d position_m(const std::string& who, std::int64_t node) const;
  bool is_of_solid(std::int64_t node) const { return nodes_.index_of.count(node) > 0; }
  /// A node of solids, in the mesh.
  std::int32_t index_of(std::int64_t node) const { return nodes_.index_of.at(node); }

  /// Of a node's translations; of a node that has another one's rotations, of these.
  std::int32_t site_of(const std::string& who, std::int64_t node);
  bool is_rotation(std::int32_t site) const;
  /// The reference point that a node is, if it is one.
  std::optional<std::int32_t> point_of(std::int64_t node) const;
  std::int32_t add_point(const std::string& who, std::int64_t node);
  /// The node's translations are the rotations of the point.
  void set_rotation_node(std::int64_t node, std::int32_t point) { rotation_nodes_[node] = point; }
  /// Whether a node that no element uses is a reference point, or has the rotations of one.
  bool is_point(std::int64_t node) const;

  /// Of a node's components; nothing if these are the mesh's.
  const AxisSystem* axes_of(std::int64_t node) const;
  /// In the mesh's axes, lengths in m; nothing for a rotation of a node of solids.
  std::optional<Term> term_of(const std::string& who, const DeckTerm& term);

  /// Nodes that no element uses and the mesh has all the same.
  std::set<std::int64_t> loose_nodes() const;

 private:
  Eigen::Matrix3d axes_at(const std::string& who, std::int64_t node) const;

  const DeckNodes& nodes_;
  Mesh& mesh_;
  std::map<std::int64_t, AxisSystem> axes_;              ///< their origins in m
  std::map<std::int64_t, std::int32_t> points_;          ///< by node
  std::map<std::int64_t, std::int32_t> rotation_nodes_;  ///< point of a node that has its rotations
};

}  // namespace flexneck::mesher
