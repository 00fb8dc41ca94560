// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/dofs/constrained_element.h"

#include <algorithm>

namespace flexneck::fe_modal {

ConstrainedElement::ConstrainedElement(std::span<const std::int32_t> nodes, const DofMap& dof_map) {
  std::vector<std::size_t> place(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (dof_map.coupling(nodes[i]) >= 0) continue;
    place[i] = numbers_.size();
    numbers_.push_back(dof_map.index(nodes[i]));
  }
  const std::size_t own_count = numbers_.size();
  const bool has_fixed = std::any_of(numbers_.begin(), numbers_.end(), [&](std::int32_t number) {
    return number >= 0 && (dof_map.is_fixed(number, 0) || dof_map.is_fixed(number, 1) ||
                           dof_map.is_fixed(number, 2));
  });
  if (own_count == nodes.size() && !has_fixed) return;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::int32_t coupling = dof_map.coupling(nodes[i]);
    if (coupling < 0) continue;
    const std::int32_t translation = dof_map.translation(coupling);
    const auto known = std::find(numbers_.begin() + static_cast<std::ptrdiff_t>(own_count),
                                 numbers_.end(), translation);
    place[i] = static_cast<std::size_t>(known - numbers_.begin());
    if (known != numbers_.end()) continue;
    numbers_.push_back(translation);
    numbers_.push_back(dof_map.rotation(coupling));
  }
  const auto n = static_cast<Eigen::Index>(nodes.size());
  const auto m = static_cast<Eigen::Index>(numbers_.size());
  motion_ = Eigen::MatrixXd::Zero(3 * n, 3 * m);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::int32_t node = nodes[static_cast<std::size_t>(i)];
    const auto column = static_cast<Eigen::Index>(place[static_cast<std::size_t>(i)]);
    const std::int32_t number = numbers_[static_cast<std::size_t>(column)];
    for (Eigen::Index a = 0; a < 3; ++a) {
      if (number < 0 || !dof_map.is_fixed(number, a)) motion_(a * n + i, a * m + column) = 1;
    }
    if (dof_map.coupling(node) < 0) continue;
    const Eigen::Vector3d arm = dof_map.arm_m(node);
    for (Eigen::Index a = 0; a < 3; ++a) {  // theta x arm
      const Eigen::Index b = (a + 1) % 3;
      const Eigen::Index c = (a + 2) % 3;
      motion_(a * n + i, b * m + column + 1) = arm[c];
      motion_(a * n + i, c * m + column + 1) = -arm[b];
    }
  }
}

Eigen::MatrixXd ConstrainedElement::reduced(const Eigen::MatrixXd& element) const {
  if (motion_.size() == 0) return element;
  return motion_.transpose() * element * motion_;
}

Eigen::MatrixXd in_three_directions(const Eigen::MatrixXd& mass) {
  const Eigen::Index n = mass.rows();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  for (Eigen::Index a = 0; a < 3; ++a) result.block(a * n, a * n, n, n) = mass;
  return result;
}

}  // namespace flexneck::fe_modal
