// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/algebra/cholesky_factor.h"
#include "fe_modal/algebra/symmetric_matrix.h"
#include "fe_modal/dofs/node_graph.h"
#include "fe_modal/solve/iterative/subdomains.h"

namespace flexneck::fe_modal {

/// Coarse space of an overlapping Schwarz method by Dohrmann, Klawonn and Widlund (SIAM J. Numer.
/// Anal. 46 (2008) 2153), which Dohrmann and Widlund (ibid. 47 (2009) 2897) prove good for nearly
/// incompressible bodies with discontinuous pressures: each piece of the interface of subdomains,
/// a face, an edge or a corner, moves rigidly while the others stand still, and the inside of the
/// subdomains follows with the least energy. Rigid motions that merely fade out would press the
/// rubber's volume together and be of no use.
class CoarseSpace {
 public:
  /// @param stiffness K, positive definite
  /// @param graph its sparsity
  /// @param subdomains those that have nodes in common meet there; together they have all nodes
  /// @param positions_m (3, nodes)
  CoarseSpace(const SymmetricMatrix& stiffness, const NodeGraph& graph, const NodeLists& subdomains,
              const Eigen::Matrix3Xd& positions_m);

  Eigen::Index size() const { return size_; }
  /// Adds C (C^T K C)^-1 C^T r to `result`, columns (dofs, k), C the functions of this space.
  void add_correction(const Eigen::MatrixXf& residuals, Eigen::MatrixXf& result) const;

 private:
  /// A connected set of interface nodes that the same subdomains share: a face, edge or vertex.
  struct Piece {
    std::vector<std::int32_t> nodes;
    Eigen::MatrixXd motions;  ///< (3 nodes, up to 6), orthonormal
    Eigen::Index first = 0;   ///< number of its first function
  };
  /// Values of the coarse functions at the nodes inside a subdomain.
  struct Inside {
    std::vector<std::int32_t> nodes;
    std::vector<std::int32_t> functions;
    Eigen::MatrixXf motions;  ///< (3 nodes, functions)
  };
  class Builder;

  std::vector<Piece> pieces_;
  std::vector<Inside> insides_;
  Eigen::Index size_ = 0;
  std::unique_ptr<CholeskyFactor> factor_;
};

}  // namespace flexneck::fe_modal
