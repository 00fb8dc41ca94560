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
#include "fe_modal/system/field_map.h"

namespace flexneck::fe_modal {

/// A body as a two-level method sees it.
struct CutBody {
  const mesher::Mesh& mesh;
  const FieldMap& fields;
  const Subdomains& subdomains;
  std::vector<std::int32_t> rank_of_subdomain;
};

/// A matrix between some blocks of the body.
struct PartMatrix {
  const SymmetricMatrix& matrix;
  const NodeGraph& graph;                   ///< its sparsity
  const std::vector<std::int32_t>& blocks;  ///< numbers of its rows in the body, ascending
};

/// Coarse space of an overlapping Schwarz method by Dohrmann, Klawonn and Widlund (SIAM J. Numer.
/// Anal. 46 (2008) 2153), which Dohrmann and Widlund (ibid. 47 (2009) 2897) prove good for nearly
/// incompressible bodies with discontinuous pressures: each piece of the interface of subdomains,
/// a face, an edge or a corner, moves rigidly while the others stand still, and the inside of the
/// subdomains follows with the least energy. Rigid motions that merely fade out would press the
/// rubber's volume together and be of no use.
class CoarseSpace {
 public:
  /// @param body all of it, and how it is cut; the same on all ranks
  /// @param part K of this rank's elements, which adds to those of the others to a definite one
  /// Collective.
  CoarseSpace(const CutBody& body, const PartMatrix& part);

  Eigen::Index size() const { return size_; }
  /// Adds C (C^T K C)^-1 C^T r to `result`, columns (own dofs, k), C the functions of this space.
  /// Collective.
  void add_correction(const Eigen::MatrixXf& residuals, Eigen::MatrixXf& result) const;

 private:
  /// A connected set of interface blocks that the same subdomains share: a face, edge or vertex.
  struct Piece {
    std::vector<std::int32_t> places;  ///< of its blocks among those that this rank owns
    Eigen::MatrixXd motions;           ///< (3 blocks, up to 6), orthonormal
    Eigen::Index first = 0;            ///< number of its first function
  };
  /// Values of the coarse functions at the blocks inside a subdomain of this rank.
  struct Inside {
    std::vector<std::int32_t> places;  ///< likewise
    std::vector<std::int32_t> functions;
    Eigen::MatrixXf motions;  ///< (3 blocks, functions)
  };
  class Builder;

  Ranks ranks_;

  std::vector<Piece> pieces_;
  std::vector<Inside> insides_;
  Eigen::Index size_ = 0;
  std::unique_ptr<CholeskyFactor> factor_;
};

}  // namespace flexneck::fe_modal
