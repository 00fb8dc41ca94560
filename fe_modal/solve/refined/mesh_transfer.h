// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "fe_modal/system/field_map.h"

namespace flexneck::fe_modal {

/// Carries fields of a mesh over to its refinement, and forces back: free values of the one to
/// those of the other, and the transpose. Every member is collective.
class MeshTransfer {
 public:
  using Prolongation = Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t>;

  /// @param prolongation of mesher::refine(); all must outlive this
  MeshTransfer(const FieldMap& coarse, const FieldMap& fine, const Prolongation& prolongation);

  /// @param vectors (own coarse dofs, k)
  /// @param result (own fine dofs, k), whose memory is written to
  void to_fine(const Eigen::MatrixXd& vectors, Eigen::MatrixXd& result) const;
  /// (own fine dofs, k) -> (own coarse dofs, k)
  Eigen::MatrixXd to_coarse(const Eigen::MatrixXd& forces) const;

 private:
  struct OwnBlock {
    Eigen::Index row;  ///< of the own fine vectors
    bool is_point;     ///< of a reference point, which the mesh before has, too
    /// Of a point its row in vectors of the mesh before, else a node that moves as the block does.
    Eigen::Index place;
  };
  /// Calls action(block, direction) for each own block and direction that depends on no other.
  template <typename Action>
  void for_each_own(const Action& action) const;

  const FieldMap& coarse_;
  const FieldMap& fine_;
  const Prolongation& prolongation_;
  std::vector<std::int32_t> site_of_block_;  ///< (fine blocks) one that moves as the block does
};

}  // namespace flexneck::fe_modal
