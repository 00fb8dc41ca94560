// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Numbers the nodes that may move; held ones have no degrees of freedom, and nodes tied to one
/// another share theirs. Degree of freedom 3 index(k) + a is direction a of node k. Keeps the order
/// of the nodes.
class FreeNodes {
 public:
  /// @param held nodes held in all directions, in range; a node tied to one of them is held too
  /// @param slits those that are tied tie their pairs
  FreeNodes(std::size_t node_count, std::span<const std::int32_t> held,
            std::span<const mesher::Slit> slits = {});
  FreeNodes(const mesher::Mesh& mesh, std::span<const std::int32_t> held)
      : FreeNodes(mesh.nodes.size(), held, mesh.slits) {}

  /// As numbered elsewhere.
  /// @param indices what index() is to return
  FreeNodes(std::vector<std::int32_t> indices, std::int32_t free_count)
      : indices_(std::move(indices)), free_count_(free_count) {}

  Eigen::Index node_count() const { return static_cast<Eigen::Index>(indices_.size()); }
  Eigen::Index free_count() const { return free_count_; }
  Eigen::Index dof_count() const { return 3 * free_count_; }

  /// Number of a node among the free ones, -1 if it is held.
  std::int32_t index(std::int32_t node) const { return indices_[static_cast<std::size_t>(node)]; }

  /// Field on all nodes, (3, n), from its free values (dof_count()); zero on held nodes.
  Eigen::Matrix3Xd expand(const Eigen::VectorXd& free_values) const;
  /// Forces on the free degrees of freedom from forces on all nodes, (3, n): the transpose of
  /// expand(). Forces on tied nodes add.
  Eigen::VectorXd gather(const Eigen::Matrix3Xd& forces) const;

 private:
  std::vector<std::int32_t> indices_;
  Eigen::Index free_count_ = 0;
};

}  // namespace flexneck::fe_modal
