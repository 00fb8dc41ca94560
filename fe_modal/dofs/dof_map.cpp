// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/dofs/dof_map.h"

#include <algorithm>

#include <Eigen/Cholesky>

#include "fe_modal/dofs/body_constraints.h"

namespace flexneck::fe_modal {
namespace {

bool is_fixed(const AffineConstraints& constraints, std::int32_t site) {
  for (std::int32_t dof = 3 * site; dof < 3 * site + 3; ++dof) {
    if (!constraints.is_dependent(dof) || !constraints.line(dof).empty()) return false;
  }
  return true;
}

/// Site with which this one moves in all directions; -1 if there is none.
std::int32_t tied_to(const AffineConstraints& constraints, std::int32_t site) {
  std::int32_t other = -1;
  for (std::int32_t a = 0; a < 3; ++a) {
    if (!constraints.is_dependent(3 * site + a)) return -1;
    const std::span<const DofTerm> line = constraints.line(3 * site + a);
    if (line.size() != 1 || line[0].coefficient != 1 || line[0].dof % 3 != a) return -1;
    if (a > 0 && line[0].dof / 3 != other) return -1;
    other = line[0].dof / 3;
  }
  return other;
}

}  // namespace

DofMap::DofMap(std::size_t node_count, std::span<const std::int32_t> fixed,
               std::span<const mesher::Slit> slits)
    : node_count_(static_cast<Eigen::Index>(node_count)) {
  number(tie_and_fix(node_count, fixed, slits));
}

DofMap::DofMap(const mesher::Mesh& mesh, std::span<const std::int32_t> fixed,
               const mesher::Connections& connections)
    : node_count_(static_cast<Eigen::Index>(mesh.nodes.size())) {
  number(connections.empty() ? tie_and_fix(mesh.nodes.size(), fixed, mesh.slits)
                             : constraints_of(mesh, fixed, connections));
}

void DofMap::number(const AffineConstraints& constraints) {
  const std::int32_t sites = constraints.dof_count() / 3;
  const auto count_dependent = [&](std::int32_t site) {
    int count = 0;
    for (int a = 0; a < 3; ++a) count += constraints.is_dependent(3 * site + a) ? 1 : 0;
    return count;
  };
  indices_.assign(static_cast<std::size_t>(sites), -1);
  for (std::int32_t site = 0; site < sites; ++site) {
    if (count_dependent(site) == 3) continue;
    indices_[static_cast<std::size_t>(site)] = static_cast<std::int32_t>(free_count_++);
    if (sites > node_count_)
      point_half_of_.push_back(
          site - static_cast<std::int32_t>(std::min<Eigen::Index>(site + 1, node_count_)));
  }
  std::vector<std::int32_t> composites;
  for (std::int32_t site = 0; site < sites; ++site) {
    if (count_dependent(site) == 0 || is_fixed(constraints, site)) continue;
    const std::int32_t other = tied_to(constraints, site);
    if (other < 0) {
      composites.push_back(site);
    } else {
      indices_[static_cast<std::size_t>(site)] = index(other);
    }
  }
  if (composites.empty() && sites == node_count_) return;
  composite_of_.assign(static_cast<std::size_t>(sites), -1);
  dependent_.assign(static_cast<std::size_t>(free_count_), {});
  for (const std::int32_t site : composites) add_composite(constraints, site);
}

void DofMap::add_composite(const AffineConstraints& constraints, std::int32_t site) {
  const auto block_dof = [&](std::int32_t dof) { return 3 * index(dof / 3) + dof % 3; };
  composite_of_[static_cast<std::size_t>(site)] =
      static_cast<std::int32_t>((offsets_.size() - 1) / 3);
  for (std::int32_t a = 0; a < 3; ++a) {
    const std::int32_t dof = 3 * site + a;
    if (!constraints.is_dependent(dof)) {
      terms_.push_back({block_dof(dof), 1});
    } else {
      for (const DofTerm& term : constraints.line(dof)) {
        terms_.push_back({block_dof(term.dof), term.coefficient});
      }
      if (index(site) >= 0) {
        dependent_[static_cast<std::size_t>(index(site))][static_cast<std::size_t>(a)] = true;
      }
    }
    offsets_.push_back(terms_.size());
  }
}

void DofMap::renumber(std::span<const std::int32_t> order) {
  std::vector<std::int32_t> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    place[static_cast<std::size_t>(order[k])] = static_cast<std::int32_t>(k);
  const auto place_of = [&](std::int32_t block) { return place[static_cast<std::size_t>(block)]; };
  const auto in_order = [&](auto& of_blocks) {
    auto before = of_blocks;
    for (std::size_t k = 0; k < before.size(); ++k)
      of_blocks[k] = before[static_cast<std::size_t>(order[k])];
  };
  for (std::int32_t& block : indices_) {
    if (block >= 0) block = place_of(block);
  }
  for (DofTerm& term : terms_) term.dof = 3 * place_of(term.dof / 3) + term.dof % 3;
  in_order(dependent_);
  in_order(point_half_of_);
}

std::span<const DofTerm> DofMap::terms(std::int32_t site, int a) const {
  const auto row = 3 * static_cast<std::size_t>(composite_of_[static_cast<std::size_t>(site)]) +
                   static_cast<std::size_t>(a);
  return std::span(terms_).subspan(offsets_[row], offsets_[row + 1] - offsets_[row]);
}

Eigen::Index DofMap::dependent_count() const {
  Eigen::Index count = 0;
  for (const std::array<bool, 3>& block : dependent_)
    count += std::count(block.begin(), block.end(), true);
  return count;
}

Eigen::Vector3d DofMap::motion_of(std::int32_t site,
                                  const Eigen::Ref<const Eigen::VectorXd>& free_values) const {
  Eigen::Vector3d motion = Eigen::Vector3d::Zero();
  if (is_plain(site)) {
    if (index(site) >= 0) motion = free_values.segment<3>(3 * index(site));
    return motion;
  }
  for (int a = 0; a < 3; ++a) {
    for (const DofTerm& term : terms(site, a))
      motion[a] += term.coefficient * free_values[term.dof];
  }
  return motion;
}

void DofMap::add_force(std::int32_t site, const Eigen::Vector3d& force,
                       Eigen::Ref<Eigen::VectorXd> values) const {
  if (is_plain(site)) {
    if (index(site) >= 0) values.segment<3>(3 * index(site)) += force;
    return;
  }
  for (int a = 0; a < 3; ++a) {
    for (const DofTerm& term : terms(site, a)) values[term.dof] += term.coefficient * force[a];
  }
}

Eigen::Matrix3Xd DofMap::expand(const Eigen::VectorXd& free_values) const {
  Eigen::Matrix3Xd field(3, node_count());
  for (std::int32_t node = 0; node < node_count(); ++node) {
    field.col(node) = motion_of(node, free_values);
  }
  return field;
}

Eigen::VectorXd DofMap::gather(const Eigen::Matrix3Xd& forces) const {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(dof_count());
  for (std::int32_t node = 0; node < node_count(); ++node) {
    add_force(node, forces.col(node), values);
  }
  return values;
}

Eigen::VectorXd DofMap::restrict(const Eigen::Matrix3Xd& field) const {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(dof_count());
  for (std::int32_t node = 0; node < node_count(); ++node) {
    if (index(node) >= 0) values.segment<3>(3 * index(node)) = field.col(node);
  }
  for (std::size_t block = 0; block < dependent_.size(); ++block) {
    for (std::size_t a = 0; a < 3; ++a) {
      if (dependent_[block][a]) values[static_cast<Eigen::Index>(3 * block + a)] = 0;
    }
  }
  fit_points(field, values);
  return values;
}

/// Fits each reference point by itself: nodes that follow several points are left out.
void DofMap::fit_points(const Eigen::Matrix3Xd& field, Eigen::VectorXd& values) const {
  using Six = Eigen::Matrix<double, 6, 1>;
  struct Fit {
    Eigen::Matrix<double, 6, 6> matrix = Eigen::Matrix<double, 6, 6>::Zero();
    Six right = Six::Zero();
  };
  std::vector<Fit> fits(static_cast<std::size_t>(site_count() - node_count()) / 2);
  if (fits.empty()) return;
  for (std::int32_t node = 0; node < node_count(); ++node) {
    for (int a = 0; a < 3 && !is_plain(node); ++a) {
      Six row = Six::Zero();
      double rest = field(a, node);
      std::size_t point = fits.size();
      bool is_of_one = true;
      for (const DofTerm& term : terms(node, a)) {
        if (!is_of_point(term.dof / 3)) {
          rest -= term.coefficient * values[term.dof];
          continue;
        }
        const auto where =
            static_cast<std::size_t>(point_half_of_[static_cast<std::size_t>(term.dof / 3)]);
        is_of_one = is_of_one && (point == fits.size() || point == where / 2);
        point = where / 2;
        row[static_cast<Eigen::Index>(3 * (where % 2)) + term.dof % 3] = term.coefficient;
      }
      if (point == fits.size() || !is_of_one) continue;
      fits[point].matrix += row * row.transpose();
      fits[point].right += row * rest;
    }
  }
  for (std::size_t p = 0; p < fits.size(); ++p) {
    for (Eigen::Index i = 0; i < 6; ++i) {
      if (fits[p].matrix(i, i) == 0) fits[p].matrix(i, i) = 1;
    }
    const Six motion = fits[p].matrix.ldlt().solve(fits[p].right);
    for (std::int32_t half = 0; half < 2; ++half) {
      const std::int32_t block =
          index(static_cast<std::int32_t>(node_count()) + 2 * static_cast<std::int32_t>(p) + half);
      if (block >= 0 && is_of_point(block))
        values.segment<3>(3 * block) = motion.segment<3>(3 * half);
    }
  }
}

}  // namespace flexneck::fe_modal
