// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/iterative/schwarz.h"

#include <utility>

#include "fe_modal/solve/iterative/submatrix.h"
#include "mesher/partition/node_order.h"

namespace flexneck::fe_modal {
namespace {

/// Largest entry of each column, 1 where all are zero: single precision knows smaller numbers only
/// down to 1e-38.
Eigen::VectorXd scales_of(const Eigen::MatrixXd& columns) {
  const Eigen::VectorXd largest = columns.cwiseAbs().colwise().maxCoeff().transpose();
  return (largest.array() > 0).select(largest, 1.0);
}

}  // namespace

SchwarzPreconditioner::SchwarzPreconditioner(const SymmetricMatrix& stiffness,
                                             const NodeGraph& graph, const NodeLists& subdomains,
                                             const Eigen::Matrix3Xd& positions_m)
    : coarse_(stiffness, graph, subdomains, positions_m) {
  for (const std::vector<std::int32_t>& subdomain : subdomains) {
    std::vector<std::int32_t> nodes = extended(graph, subdomain);
    const NodeGraph part = restrict_to(graph, nodes);
    SubdomainFactor factor(principal_part(stiffness, part, nodes),
                           mesher::nested_dissection(part.offsets(), part.columns()));
    nonzeros_ += factor.nonzeros();
    regions_.push_back({std::move(nodes), std::move(factor)});
  }
}

Eigen::MatrixXd SchwarzPreconditioner::apply(const Eigen::MatrixXd& residuals) const {
  const Eigen::VectorXd scales = scales_of(residuals);
  const Eigen::MatrixXf scaled = (residuals * scales.cwiseInverse().asDiagonal()).cast<float>();
  Eigen::MatrixXf result = Eigen::MatrixXf::Zero(residuals.rows(), residuals.cols());
  coarse_.add_correction(scaled, result);
  for (const Region& region : regions_) region.factor.add_solution(scaled, region.nodes, result);
  return result.cast<double>() * scales.asDiagonal();
}

}  // namespace flexneck::fe_modal
