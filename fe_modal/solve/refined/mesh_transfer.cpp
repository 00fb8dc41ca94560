// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/refined/mesh_transfer.h"

namespace flexneck::fe_modal {
namespace {

/// A row for each node, column a k + c: direction a of field c.
using FieldRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

MeshTransfer::MeshTransfer(const FieldMap& coarse, const FieldMap& fine,
                           const Prolongation& prolongation)
    : coarse_(coarse), fine_(fine), prolongation_(prolongation) {
  const DofMap& dof_map = fine.dof_map();
  site_of_block_.assign(static_cast<std::size_t>(dof_map.free_count()), -1);
  for (auto site = static_cast<std::int32_t>(dof_map.site_count()) - 1; site >= 0; --site) {
    const std::int32_t block = dof_map.index(site);
    if (block >= 0) site_of_block_[static_cast<std::size_t>(block)] = site;
  }
}

template <typename Action>
void MeshTransfer::for_each_own(const Action& action) const {
  const DofLayout& layout = fine_.layout();
  const auto nodes = static_cast<std::int32_t>(fine_.dof_map().node_count());
  const auto coarse_nodes = static_cast<std::int32_t>(coarse_.dof_map().node_count());
  for (std::size_t k = 0; k < site_of_block_.size(); ++k) {
    const auto block = static_cast<std::int32_t>(k);
    const std::int32_t site = site_of_block_[k];
    if (layout.owner(block) != layout.ranks().own() || site < 0) continue;
    const bool is_point = site >= nodes;
    const OwnBlock own{3 * static_cast<Eigen::Index>(layout.place(block)), is_point,
                       is_point ? 3 * static_cast<Eigen::Index>(
                                          coarse_.dof_map().index(site - nodes + coarse_nodes))
                                : site};
    for (Eigen::Index a = 0; a < 3; ++a) {
      if (!fine_.dof_map().is_dependent(block, a)) action(own, a);
    }
  }
}

void MeshTransfer::to_fine(const Eigen::MatrixXd& vectors, Eigen::MatrixXd& result) const {
  const DofMap& coarse = coarse_.dof_map();
  const Eigen::MatrixXd whole = coarse_.layout().whole(vectors);
  const Eigen::Index k = vectors.cols();
  FieldRows before(coarse.node_count(), 3 * k);
  for (std::int32_t node = 0; node < static_cast<std::int32_t>(before.rows()); ++node) {
    for (Eigen::Index c = 0; c < k; ++c) {
      const Eigen::Vector3d motion = coarse.motion_of(node, whole.col(c));
      for (Eigen::Index a = 0; a < 3; ++a) before(node, a * k + c) = motion[a];
    }
  }
  const FieldRows after = prolongation_ * before;
  result.setZero();
  for_each_own([&](const OwnBlock& own, Eigen::Index a) {
    for (Eigen::Index c = 0; c < k; ++c) {
      result(own.row + a, c) = own.is_point ? whole(own.place + a, c) : after(own.place, a * k + c);
    }
  });
}

Eigen::MatrixXd MeshTransfer::to_coarse(const Eigen::MatrixXd& forces) const {
  const DofMap& coarse = coarse_.dof_map();
  const Eigen::Index k = forces.cols();
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(coarse.dof_count(), k);
  FieldRows after = FieldRows::Zero(fine_.dof_map().node_count(), 3 * k);
  for_each_own([&](const OwnBlock& own, Eigen::Index a) {
    for (Eigen::Index c = 0; c < k; ++c) {
      double& sum = own.is_point ? whole(own.place + a, c) : after(own.place, a * k + c);
      sum += forces(own.row + a, c);
    }
  });
  const FieldRows before = prolongation_.transpose() * after;
  for (std::int32_t node = 0; node < static_cast<std::int32_t>(before.rows()); ++node) {
    for (Eigen::Index c = 0; c < k; ++c) {
      coarse.add_force(node, {before(node, c), before(node, k + c), before(node, 2 * k + c)},
                       whole.col(c));
    }
  }
  coarse_.ranks().sum(whole);
  return coarse_.layout().own_rows(whole);
}

}  // namespace flexneck::fe_modal
