// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "fe_modal/cholesky_factor.h"
#include "fe_modal/node_graph.h"
#include "fe_modal/symmetric_matrix.h"

namespace flexneck::fe_modal {

/// Nodes that overlap with others' and the low-energy motions of a region: rigid ones, fading out
/// where regions overlap.
struct Region {
  std::vector<std::int32_t> nodes;  ///< ascending
  Eigen::MatrixXd motions;          ///< (3 nodes, 6)
};

/// Additive Schwarz preconditioner with two levels (Toselli and Widlund, Domain Decomposition
/// Methods, 2005, ch. 3): exact solves on overlapping subdomains, whose number grows with the body
/// so that their size does not, and one on the rigid motions of subdomains and of parts. Algebraic
/// multigrid with rigid motions fails here: on the default neck, whose rubber is 8300 times softer
/// than its plates and nearly incompressible, conjugate gradients stall with it.
class SchwarzPreconditioner {
 public:
  /// @param stiffness positive definite
  /// @param graph its sparsity
  /// @param subdomains solved exactly; together they cover all nodes
  /// @param more regions that move rigidly at little cost: parts
  SchwarzPreconditioner(const SymmetricMatrix& stiffness, const NodeGraph& graph,
                        std::vector<Region> subdomains, std::vector<Region> more);

  /// For each column, (dofs, k).
  Eigen::MatrixXd apply(const Eigen::MatrixXd& residuals) const;
  double nonzeros() const { return nonzeros_; }
  std::size_t subdomain_count() const { return subdomain_count_; }

 private:
  void factorise(const SymmetricMatrix& stiffness, const NodeGraph& graph, const Region& region);
  void make_coarse(const SymmetricMatrix& stiffness, const NodeGraph& graph);

  std::size_t subdomain_count_;
  std::vector<Region> regions_;  ///< subdomains, then the others
  std::vector<std::unique_ptr<CholeskyFactor>> factors_;
  Eigen::LDLT<Eigen::MatrixXd> coarse_;
  double nonzeros_ = 0;
};

/// One region for each process of an element partition, a layer of elements wider than its
/// elements, and one for each part.
struct Regions {
  std::vector<Region> subdomains;
  std::vector<Region> parts;
};
Regions find_regions(const mesher::Mesh& mesh, const FreeNodes& free_nodes, const NodeGraph& graph);

}  // namespace flexneck::fe_modal
