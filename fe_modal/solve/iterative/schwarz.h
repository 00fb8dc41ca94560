// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/algebra/ghost_exchange.h"
#include "fe_modal/algebra/symmetric_matrix.h"
#include "fe_modal/dofs/node_graph.h"
#include "fe_modal/solve/iterative/coarse_space.h"
#include "fe_modal/solve/iterative/subdomain_factor.h"
#include "fe_modal/solve/iterative/subdomains.h"

namespace flexneck::fe_modal {

/// Additive Schwarz preconditioner with two levels (Toselli and Widlund, Domain Decomposition
/// Methods, 2005, ch. 3): exact solves on subdomains that overlap, extended(), and one in a coarse
/// space. It works in single precision: half the memory, which is what bounds the size of the body,
/// and half the time.
class SchwarzPreconditioner {
 public:
  /// @param body all of it, and how it is cut; the same on all ranks
  /// @param part the matrix of this rank's elements
  /// @param around the whole matrix, positive definite, in the rows of this rank's subdomains and
  /// the
  ///     blocks next to them
  /// Collective.
  SchwarzPreconditioner(const CutBody& body, const PartMatrix& part, const PartMatrix& around);

  /// For each column, (own dofs, k), to some six digits. Collective.
  Eigen::MatrixXd apply(const Eigen::MatrixXd& residuals) const;
  double nonzeros() const { return nonzeros_; }  ///< of the factors of all ranks
  std::size_t subdomain_count() const { return subdomain_count_; }
  Eigen::Index coarse_size() const { return coarse_.size(); }

 private:
  /// Of columns whose largest entries are 1.
  Eigen::MatrixXd apply_to_unit(const Eigen::MatrixXd& residuals) const;

  struct Region {
    SubdomainFactor factor;
    std::vector<Eigen::Index> rows;  ///< of `around`, in the order of elimination
  };

  Ranks ranks_;
  CoarseSpace coarse_;
  GhostExchange exchange_;  ///< of the rows of `around`
  std::vector<Region> regions_;
  std::size_t subdomain_count_;
  double nonzeros_ = 0;
};

}  // namespace flexneck::fe_modal
