// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/dofs/constrained_element.h"

#include <algorithm>

namespace flexneck::fe_modal {

ConstrainedElement::ConstrainedElement(std::span<const std::int32_t> sites, const DofMap& dof_map) {
  const auto is_plain = [&](std::int32_t site) { return dof_map.is_plain(site); };
  if (std::all_of(sites.begin(), sites.end(), is_plain)) {
    for (const std::int32_t site : sites) numbers_.push_back(dof_map.index(site));
    return;
  }
  for (const std::int32_t site : sites) {
    dof_map.for_each_number(site, [&](std::int32_t block) { numbers_.push_back(block); });
  }
  std::sort(numbers_.begin(), numbers_.end());
  numbers_.erase(std::unique(numbers_.begin(), numbers_.end()), numbers_.end());
  const auto n = static_cast<Eigen::Index>(sites.size());
  const auto m = static_cast<Eigen::Index>(numbers_.size());
  const auto column = [&](std::int32_t block) -> Eigen::Index {
    return std::lower_bound(numbers_.begin(), numbers_.end(), block) - numbers_.begin();
  };
  motion_ = Eigen::MatrixXd::Zero(3 * n, 3 * m);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::int32_t site = sites[static_cast<std::size_t>(i)];
    for (int a = 0; a < 3; ++a) {
      if (is_plain(site)) {
        const std::int32_t block = dof_map.index(site);
        if (block >= 0) motion_(a * n + i, a * m + column(block)) = 1;
        continue;
      }
      for (const DofTerm& term : dof_map.terms(site, a)) {
        motion_(a * n + i, term.dof % 3 * m + column(term.dof / 3)) = term.coefficient;
      }
    }
  }
}

Eigen::MatrixXd ConstrainedElement::reduced(Eigen::MatrixXd element) const {
  if (motion_.size() == 0 && 3 * numbers_.size() == static_cast<std::size_t>(element.rows())) {
    return element;
  }
  return motion_.transpose() * element * motion_;
}

Eigen::MatrixXd in_three_directions(const Eigen::MatrixXd& mass) {
  const Eigen::Index n = mass.rows();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  for (Eigen::Index a = 0; a < 3; ++a) result.block(a * n, a * n, n, n) = mass;
  return result;
}

}  // namespace flexneck::fe_modal
