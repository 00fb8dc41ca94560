// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/algebra/dof_layout.h"
#include "fe_modal/dofs/dof_map.h"
#include "mesher/mesh/submesh.h"

namespace flexneck::fe_modal {

/// Some elements of a mesh with the blocks of degrees of freedom that they have. Blocks between the
/// elements of two ranks are in both parts: the matrices of the parts add up to those of the body.
class RankPart {
 public:
  /// All of the mesh, which must outlive this.
  RankPart(const mesher::Mesh& mesh, const DofMap& dof_map);
  /// @param numbers of the elements, as for_each_element() counts them
  /// @param number of those that are in the part
  RankPart(const mesher::Mesh& mesh, const DofMap& dof_map,
           const std::vector<std::int32_t>& numbers, std::int32_t number);

  const mesher::Mesh& mesh() const { return piece_ ? piece_->mesh : whole_; }
  const DofMap& dof_map() const { return piece_ ? *dof_map_ : whole_dof_map_; }
  /// Numbers in the whole, ascending until renumber().
  const std::vector<std::int32_t>& blocks() const { return blocks_; }

  /// Numbers the blocks in an order, a permutation of them: entry k becomes block k.
  /// @pre not the whole, and not constrained
  void renumber(std::span<const std::int32_t> order);

  /// Rows of the part's nodes of those of all, (n, k).
  Eigen::MatrixXd rows_of_nodes(const Eigen::MatrixXd& all) const;
  /// Columns of the part's nodes of a field on all, (3, n); of an empty one none.
  Eigen::Matrix3Xd columns_of_nodes(const Eigen::Matrix3Xd& all) const;

 private:
  const mesher::Mesh& whole_;
  const DofMap& whole_dof_map_;
  std::optional<mesher::MeshPiece> piece_;  ///< nothing: the whole
  std::optional<DofMap> dof_map_;           ///< likewise
  std::vector<std::int32_t> blocks_;
};

/// Elements, point masses and springs.
std::size_t element_count(const mesher::Mesh& mesh);

/// Calls visit(number of the element, its nodes) for each element, the mesh's blocks in their
/// order; behind them for springs and point masses, with their sites.
void for_each_element(const mesher::Mesh& mesh,
                      const std::function<void(std::size_t, std::span<const std::int32_t>)>& visit);

/// Where vectors lie if the elements are shared out: a block is of the lowest rank that has one of
/// its elements.
/// @param rank_of_element as for_each_element() counts them
DofLayout layout_of(const Ranks& ranks, const mesher::Mesh& mesh, const DofMap& dof_map,
                    const std::vector<std::int32_t>& rank_of_element);

}  // namespace flexneck::fe_modal
