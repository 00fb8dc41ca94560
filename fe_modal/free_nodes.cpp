// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/free_nodes.h"

#include <algorithm>
#include <numeric>

namespace flexneck::fe_modal {
namespace {

/// The lowest node of those that are tied together, for each node. Where cuts cross, more than two
/// nodes are one.
class TiedNodes {
 public:
  explicit TiedNodes(std::size_t node_count) : next_(node_count) {
    std::iota(next_.begin(), next_.end(), 0);
  }

  void tie(std::int32_t one, std::int32_t other) {
    const std::int32_t a = lowest(one);
    const std::int32_t b = lowest(other);
    next_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }

  std::int32_t lowest(std::int32_t node) const {
    while (next_[static_cast<std::size_t>(node)] != node) {
      node = next_[static_cast<std::size_t>(node)];
    }
    return node;
  }

 private:
  std::vector<std::int32_t> next_;  ///< a lower node that it is tied to, or itself
};

}  // namespace

FreeNodes::FreeNodes(std::size_t node_count, std::span<const std::int32_t> held,
                     std::span<const mesher::Slit> slits)
    : indices_(node_count, 0) {
  TiedNodes tied(node_count);
  for (const mesher::Slit& slit : slits) {
    if (!slit.tied) continue;
    for (std::size_t p = 0; p < slit.lower.size(); ++p) tied.tie(slit.lower[p], slit.upper[p]);
  }
  for (const std::int32_t node : held) {
    indices_.at(static_cast<std::size_t>(tied.lowest(node))) = -1;
  }
  std::int32_t next = 0;
  for (std::size_t k = 0; k < node_count; ++k) {
    const auto lowest = static_cast<std::size_t>(tied.lowest(static_cast<std::int32_t>(k)));
    if (lowest < k) {
      indices_[k] = indices_[lowest];
    } else if (indices_[k] == 0) {
      indices_[k] = next++;
    }
  }
  free_count_ = next;
}

Eigen::Matrix3Xd FreeNodes::expand(const Eigen::VectorXd& free_values) const {
  Eigen::Matrix3Xd field = Eigen::Matrix3Xd::Zero(3, node_count());
  for (std::size_t k = 0; k < indices_.size(); ++k) {
    if (indices_[k] < 0) continue;
    field.col(static_cast<Eigen::Index>(k)) = free_values.segment<3>(3 * indices_[k]);
  }
  return field;
}

Eigen::VectorXd FreeNodes::gather(const Eigen::Matrix3Xd& forces) const {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(dof_count());
  for (std::size_t k = 0; k < indices_.size(); ++k) {
    if (indices_[k] < 0) continue;
    values.segment<3>(3 * indices_[k]) += forces.col(static_cast<Eigen::Index>(k));
  }
  return values;
}

}  // namespace flexneck::fe_modal
