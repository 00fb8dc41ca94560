// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/iterative/interface_pieces.h"

#include <algorithm>

#include <Eigen/Eigenvalues>

#include "fe_modal/body/skew.h"

namespace flexneck::fe_modal {
namespace {

/// The subdomains of each node.
NodeLists subdomains_of_nodes(std::int32_t node_count, const NodeLists& subdomains) {
  NodeLists result(static_cast<std::size_t>(node_count));
  for (std::size_t s = 0; s < subdomains.size(); ++s) {
    for (const std::int32_t node : subdomains[s]) {
      result[static_cast<std::size_t>(node)].push_back(static_cast<std::int32_t>(s));
    }
  }
  return result;
}

}  // namespace

InterfacePieces interface_pieces(const NodeGraph& graph, const NodeLists& subdomains) {
  const NodeLists owners = subdomains_of_nodes(graph.node_count(), subdomains);
  InterfacePieces result{std::vector<std::int32_t>(owners.size(), -1), {}};
  for (std::int32_t start = 0; start < graph.node_count(); ++start) {
    const auto& shared = owners[static_cast<std::size_t>(start)];
    if (shared.size() < 2 || result.piece_of[static_cast<std::size_t>(start)] >= 0) continue;
    const auto piece = static_cast<std::int32_t>(result.nodes.size());
    std::vector<std::int32_t> nodes = {start};
    result.piece_of[static_cast<std::size_t>(start)] = piece;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      for (const std::int32_t other : graph.neighbours(nodes[k])) {
        const auto place = static_cast<std::size_t>(other);
        if (result.piece_of[place] >= 0 || owners[place] != shared) continue;
        result.piece_of[place] = piece;
        nodes.push_back(other);
      }
    }
    std::sort(nodes.begin(), nodes.end());
    result.nodes.push_back(std::move(nodes));
  }
  return result;
}

Eigen::MatrixXd rigid_motions(const std::vector<std::int32_t>& nodes,
                              const Eigen::Matrix3Xd& positions_m) {
  /// Of the squares of lengths: less is rounding, or a line that is hardly bent.
  constexpr double kNoMotion = 1e-6;
  const Eigen::Matrix3Xd positions = positions_m(Eigen::all, nodes);
  Eigen::Matrix3Xd arms = positions.colwise() - positions.rowwise().mean();
  const double extent = arms.colwise().norm().maxCoeff();
  if (extent > 0) arms /= extent;
  Eigen::MatrixXd motions(3 * arms.cols(), 6);
  for (Eigen::Index k = 0; k < arms.cols(); ++k)
    motions.middleRows<3>(3 * k) = rigid_motions_at(arms.col(k));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> gram(motions.transpose() * motions);
  const Eigen::VectorXd& squares = gram.eigenvalues();
  const Eigen::Index rank = (squares.array() > kNoMotion * squares[5]).count();
  return motions * gram.eigenvectors().rightCols(rank) *
         squares.tail(rank).cwiseSqrt().cwiseInverse().asDiagonal();
}

}  // namespace flexneck::fe_modal
