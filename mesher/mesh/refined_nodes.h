// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_set>
#include <vector>

namespace flexneck::mesher {

/// A node and the value of its shape function.
struct NodeWeight {
  std::int32_t node;
  double value;
};

/// A position given by the shape functions that are not zero there.
struct Position {
  std::span<const NodeWeight> weights;    ///< by nodes of a mesh, or by local nodes
  const std::int32_t* element = nullptr;  ///< nodes of the element, if by local nodes

  std::int32_t node_of(const NodeWeight& weight) const {
    return element == nullptr ? weight.node : element[weight.node];
  }
};

/// Nodes of a finer mesh, identified by their positions in the coarse mesh: elements that share a
/// face, an edge or a node describe its nodes by the same weights, in any order. Nodes of the
/// coarse mesh come first and keep their numbers.
class RefinedNodes {
 public:
  explicit RefinedNodes(std::size_t old_count);
  RefinedNodes(const RefinedNodes&) = delete;  // the table of numbers points into it
  RefinedNodes& operator=(const RefinedNodes&) = delete;
  ~RefinedNodes() = default;

  /// Number of the node at a position; a new number if it is not known.
  /// @param position its weights and element are kept by reference
  std::int32_t number(const Position& position);
  std::optional<std::int32_t> find(const Position& position) const;

  std::size_t size() const { return old_count_ + positions_.size(); }
  /// Number of weights of all nodes together.
  std::size_t weight_count() const;
  /// Writes the weights of a node.
  /// @param weights are overwritten
  void find_weights(std::size_t number, std::vector<NodeWeight>& weights) const;

 private:
  const Position& new_position(std::int32_t number) const {
    return positions_[static_cast<std::size_t>(number) - old_count_];
  }
  struct Hash {
    using is_transparent = void;
    const RefinedNodes* nodes;
    std::size_t operator()(const Position& position) const;
    std::size_t operator()(std::int32_t number) const {
      return (*this)(nodes->new_position(number));
    }
  };
  struct Same {
    using is_transparent = void;
    const RefinedNodes* nodes;
    bool operator()(std::int32_t a, std::int32_t b) const { return a == b; }
    bool operator()(const Position& position, std::int32_t number) const;
    bool operator()(std::int32_t number, const Position& position) const {
      return (*this)(position, number);
    }
  };

  std::size_t old_count_;
  std::vector<Position> positions_;  ///< positions of the new nodes
  std::unordered_set<std::int32_t, Hash, Same> numbers_;
};

}  // namespace flexneck::mesher
