// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/iterative/interface_pieces.h"

#include <algorithm>
#include <numeric>

#include <Eigen/QR>

#include "fe_modal/algebra/ghost_exchange.h"
#include "fe_modal/body/skew.h"
#include "fe_modal/system/rank_part.h"
#include "geometry/foundation/symmetric_pairs.h"
#include "mesher/mesh/positions.h"

namespace flexneck::fe_modal {
namespace {

/// The subdomains of each block.
NodeLists subdomains_of_blocks(std::size_t block_count, const Subdomains& subdomains) {
  NodeLists result(block_count);
  for (std::size_t s = 0; s < subdomains.blocks.size(); ++s) {
    for (const std::int32_t block : subdomains.blocks[s]) {
      result[static_cast<std::size_t>(block)].push_back(static_cast<std::int32_t>(s));
    }
  }
  return result;
}

/// Sets of blocks that hang together, each known by its lowest one.
class Components {
 public:
  explicit Components(std::size_t count) : lower_(count) {
    std::iota(lower_.begin(), lower_.end(), 0);
  }
  std::int32_t lowest(std::int32_t block) {
    std::int32_t& lower = lower_[static_cast<std::size_t>(block)];
    if (lower != block) lower = lowest(lower);
    return lower;
  }
  void unite(std::int32_t one, std::int32_t other) {
    const std::int32_t a = lowest(one);
    const std::int32_t b = lowest(other);
    lower_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }

 private:
  std::vector<std::int32_t> lower_;
};

}  // namespace

InterfacePieces interface_pieces(const mesher::Mesh& mesh, const DofMap& dof_map,
                                 const Subdomains& subdomains) {
  const auto count = static_cast<std::size_t>(dof_map.free_count());
  const NodeLists owners = subdomains_of_blocks(count, subdomains);
  Components components(count);
  std::vector<std::int32_t> shared;
  for_each_element(mesh, [&](std::size_t /*element*/, std::span<const std::int32_t> nodes) {
    shared.clear();
    for (const std::int32_t node : nodes) {
      dof_map.for_each_number(node, [&](std::int32_t block) {
        if (owners[static_cast<std::size_t>(block)].size() > 1) shared.push_back(block);
      });
    }
    for (std::size_t i = 0; i < shared.size(); ++i) {
      for (std::size_t j = i + 1; j < shared.size(); ++j) {
        if (owners[static_cast<std::size_t>(shared[i])] ==
            owners[static_cast<std::size_t>(shared[j])]) {
          components.unite(shared[i], shared[j]);
        }
      }
    }
  });
  InterfacePieces result{std::vector<std::int32_t>(count, -1), {}};
  for (std::size_t block = 0; block < count; ++block) {
    if (owners[block].size() < 2) continue;
    const auto number = static_cast<std::int32_t>(block);
    const std::int32_t lowest = components.lowest(number);
    if (lowest == number) {
      result.piece_of[block] = static_cast<std::int32_t>(result.blocks.size());
      result.blocks.emplace_back();
    }
    result.piece_of[block] = result.piece_of[static_cast<std::size_t>(lowest)];
    result.blocks[static_cast<std::size_t>(result.piece_of[block])].push_back(number);
  }
  return result;
}

Eigen::MatrixXd rigid_motions(const mesher::Mesh& mesh, const DofMap& dof_map) {
  const Eigen::Matrix3Xd positions = mesher::positions_of(mesh);
  Eigen::MatrixXd motions(dof_map.dof_count(), 6);
  for (Eigen::Index i = 0; i < 6; ++i) {
    Eigen::Matrix3Xd field(3, positions.cols());
    for (Eigen::Index k = 0; k < positions.cols(); ++k) {
      field.col(k) = rigid_motions_at(positions.col(k)).col(i);
    }
    motions.col(i) = dof_map.restrict(field);
  }
  return motions;
}

Eigen::MatrixXd rigid_motions_of(const std::vector<std::int32_t>& blocks,
                                 const Eigen::MatrixXd& rigid) {
  /// Of the squares of lengths: less is rounding, or a line that is hardly bent.
  constexpr double kNoMotion = 1e-6;
  Eigen::MatrixXd motions = rigid(rows_of(blocks), Eigen::all);
  // Rotations about the middle of the blocks, as large as translations.
  auto rotations = motions.rightCols<3>();
  rotations -= (motions.leftCols<3>() *
                motions.leftCols<3>().completeOrthogonalDecomposition().solve(rotations))
                   .eval();
  const double largest = rotations.rowwise().norm().maxCoeff();
  if (largest > 0) rotations /= largest;
  const auto [squares, vectors] = symmetric_pairs(motions.transpose() * motions);
  const Eigen::Index rank = (squares.array() > kNoMotion * squares[5]).count();
  return motions * vectors.rightCols(rank) *
         squares.tail(rank).cwiseSqrt().cwiseInverse().asDiagonal();
}

}  // namespace flexneck::fe_modal
