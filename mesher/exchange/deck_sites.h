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

/// Map from a deck's nodes to the sites of a mesh. Nodes that no element uses become reference
/// points when they are first requested.
class DeckSites {
 public:
  /// @throws InputError for a node on the axis of its cylindrical system that is fixed or moved
  /// along only one of the two transverse directions; if both or neither are fixed, it gets
  /// Cartesian axes.
  DeckSites(const DeckConnections& deck, const DeckNodes& nodes, Mesh& mesh);

  // `who` names the requesting connection in messages.
  // @throws InputError for nodes that the deck does not define.

  Eigen::Vector3d position_m(const std::string& who, std::int64_t node) const;
  bool is_of_solid(std::int64_t node) const { return nodes_.index_of.count(node) > 0; }
  /// Index in the mesh of a node of solids.
  std::int32_t index_of(std::int64_t node) const { return nodes_.index_of.at(node); }

  /// Site of a node's translations; for a node that represents another's rotations, the site of
  /// these.
  std::int32_t site_of(const std::string& who, std::int64_t node);
  bool is_rotation(std::int32_t site) const;
  /// The reference point of a node, if it has one.
  std::optional<std::int32_t> point_of(std::int64_t node) const;
  std::int32_t add_point(const std::string& who, std::int64_t node);
  /// Declares that the node's translations are the rotations of the point.
  void set_rotation_node(std::int64_t node, std::int32_t point) { rotation_nodes_[node] = point; }
  /// Returns whether a node that no element uses is a reference point, or represents the rotations
  /// of one.
  bool is_point(std::int64_t node) const;

  /// Axes of a node's components; null if they are the mesh's.
  const AxisSystem* axes_of(std::int64_t node) const;
  /// The term in the mesh's axes, lengths in m; none for a rotation of a node of solids.
  std::optional<Term> term_of(const std::string& who, const DeckTerm& term);

  /// Nodes that no element uses but the mesh keeps.
  std::set<std::int64_t> loose_nodes() const;

 private:
  Eigen::Matrix3d axes_at(const std::string& who, std::int64_t node) const;

  const DeckNodes& nodes_;
  Mesh& mesh_;
  std::map<std::int64_t, AxisSystem> axes_;              ///< origins in m
  std::map<std::int64_t, std::int32_t> points_;          ///< point of a node
  std::map<std::int64_t, std::int32_t> rotation_nodes_;  ///< point whose rotations it has
};

}  // namespace flexneck::mesher
