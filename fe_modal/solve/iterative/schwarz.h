// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/algebra/symmetric_matrix.h"
#include "fe_modal/dofs/node_graph.h"
#include "fe_modal/solve/iterative/coarse_space.h"
#include "fe_modal/solve/iterative/subdomain_factor.h"
#include "fe_modal/solve/iterative/subdomains.h"

namespace flexneck::fe_modal {

/// Additive Schwarz preconditioner with two levels (Toselli and Widlund, Domain Decomposition
/// Methods, 2005, ch. 3): exact solves on subdomains that overlap by a layer of elements, and one
/// in a coarse space. It works in single precision: half the memory, which is what bounds the size
/// of the body, and half the time.
class SchwarzPreconditioner {
 public:
  /// @param stiffness positive definite
  /// @param graph its sparsity
  /// @param subdomains before they are extended; together they have all nodes
  /// @param positions_m (3, nodes)
  SchwarzPreconditioner(const SymmetricMatrix& stiffness, const NodeGraph& graph,
                        const NodeLists& subdomains, const Eigen::Matrix3Xd& positions_m);

  /// For each column, (dofs, k), to some six digits.
  Eigen::MatrixXd apply(const Eigen::MatrixXd& residuals) const;
  double nonzeros() const { return nonzeros_; }
  std::size_t subdomain_count() const { return regions_.size(); }
  Eigen::Index coarse_size() const { return coarse_.size(); }

 private:
  struct Region {
    std::vector<std::int32_t> nodes;
    SubdomainFactor factor;
  };

  CoarseSpace coarse_;
  std::vector<Region> regions_;
  double nonzeros_ = 0;
};

}  // namespace flexneck::fe_modal
