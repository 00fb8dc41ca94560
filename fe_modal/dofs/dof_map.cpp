// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/dofs/dof_map.h"

#include <algorithm>
#include <numeric>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "fe_modal/body/skew.h"
#include "geometry/foundation/error.h"
#include "mesher/mesh/positions.h"

namespace flexneck::fe_modal {
namespace {

/// The lowest node of those that are tied together, for each node. Where cuts cross, more than two
/// nodes are one.
class TiedNodes {
 public:
  explicit TiedNodes(std::size_t node_count) : next_(node_count) {
    std::iota(next_.begin(), next_.end(), 0);
  }

  void coupling(std::int32_t one, std::int32_t other) {
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

DofMap::DofMap(std::size_t node_count, std::span<const std::int32_t> fixed,
               std::span<const mesher::Slit> slits)
    : indices_(node_count, 0) {
  TiedNodes tied(node_count);
  for (const mesher::Slit& slit : slits) {
    if (!slit.tied) continue;
    for (std::size_t p = 0; p < slit.lower.size(); ++p) tied.coupling(slit.lower[p], slit.upper[p]);
  }
  for (const std::int32_t node : fixed) {
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

DofMap::DofMap(const mesher::Mesh& mesh, std::span<const std::int32_t> fixed,
               std::span<const RigidCoupling> couplings,
               std::span<const FixedDirections> directions)
    : DofMap(mesh.nodes.size(), fixed, mesh.slits) {
  if (!couplings.empty()) couple_rigidly(mesh, couplings);
  if (!directions.empty()) fix(directions, couplings);
}

void DofMap::couple_rigidly(const mesher::Mesh& mesh, std::span<const RigidCoupling> couplings) {
  // By the numbers that nodes have so far, which slits may have given to several.
  std::vector<std::int32_t> coupling_of_number(static_cast<std::size_t>(free_count_), -1);
  for (std::size_t t = 0; t < couplings.size(); ++t) {
    for (const std::int32_t node : couplings[t].nodes) {
      if (index(node) < 0) {
        throw InputError("rigid interface '" + couplings[t].name + "' has nodes that are fixed");
      }
      std::int32_t& coupling = coupling_of_number[static_cast<std::size_t>(index(node))];
      if (coupling >= 0 && coupling != static_cast<std::int32_t>(t)) {
        throw InputError("rigid interfaces '" + couplings[static_cast<std::size_t>(coupling)].name +
                         "' and '" + couplings[t].name + "' share nodes");
      }
      coupling = static_cast<std::int32_t>(t);
    }
  }
  std::vector<std::int32_t> new_number(coupling_of_number.size());
  for (std::size_t k = 0; k < new_number.size(); ++k) {
    new_number[k] = coupling_of_number[k] < 0 ? first_coupling_++ : -1;
  }
  free_count_ = first_coupling_ + 2 * static_cast<Eigen::Index>(couplings.size());
  coupling_of_.assign(indices_.size(), -1);
  arms_m_ = Eigen::Matrix3Xd::Zero(3, node_count());
  const auto positions = mesher::positions_of(mesh);
  for (std::size_t k = 0; k < indices_.size(); ++k) {
    if (indices_[k] < 0) continue;
    const auto number = static_cast<std::size_t>(indices_[k]);
    coupling_of_[k] = coupling_of_number[number];
    indices_[k] = new_number[number];
    if (coupling_of_[k] < 0) continue;
    arms_m_.col(static_cast<Eigen::Index>(k)) =
        positions.col(static_cast<Eigen::Index>(k)) -
        couplings[static_cast<std::size_t>(coupling_of_[k])].point_m;
  }
}

void DofMap::fix(std::span<const FixedDirections> directions,
                 std::span<const RigidCoupling> couplings) {
  fixed_.assign(static_cast<std::size_t>(free_count_), {});
  for (const FixedDirections& fixed : directions) {
    for (const std::int32_t node : fixed.nodes) {
      if (coupling(node) >= 0) {
        throw InputError("rigid interface '" +
                         couplings[static_cast<std::size_t>(coupling(node))].name +
                         "' has nodes that are fixed");
      }
      if (index(node) < 0) continue;
      for (std::size_t a = 0; a < 3; ++a) {
        bool& is_fixed = fixed_[static_cast<std::size_t>(index(node))][a];
        is_fixed = is_fixed || fixed.is_fixed[a];
      }
    }
  }
}

DofMap DofMap::part(std::span<const std::int32_t> nodes, std::vector<std::int32_t>& numbers) const {
  numbers.clear();
  for (const std::int32_t node : nodes) {
    for_each_number(node, [&](std::int32_t number) { numbers.push_back(number); });
  }
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  const auto place = [&](std::int32_t number) {
    return static_cast<std::int32_t>(std::lower_bound(numbers.begin(), numbers.end(), number) -
                                     numbers.begin());
  };
  DofMap result;
  result.free_count_ = static_cast<Eigen::Index>(numbers.size());
  result.first_coupling_ = place(first_coupling_);
  for (const std::int32_t node : nodes) {
    result.indices_.push_back(index(node) < 0 ? -1 : place(index(node)));
    if (!has_rigid_couplings()) continue;
    result.coupling_of_.push_back(
        coupling(node) < 0 ? -1
                           : (place(translation(coupling(node))) - result.first_coupling_) / 2);
  }
  if (has_rigid_couplings()) result.arms_m_ = arms_m_(Eigen::all, nodes);
  if (!fixed_.empty()) {
    for (const std::int32_t number : numbers) {
      result.fixed_.push_back(fixed_[static_cast<std::size_t>(number)]);
    }
  }
  return result;
}

Eigen::Index DofMap::fixed_direction_count() const {
  Eigen::Index count = 0;
  for (const std::array<bool, 3>& fixed : fixed_)
    count += std::count(fixed.begin(), fixed.end(), true);
  return count;
}

void DofMap::clear_fixed(Eigen::VectorXd& values) const {
  for (std::size_t k = 0; k < fixed_.size(); ++k) {
    for (std::size_t a = 0; a < 3; ++a) {
      if (fixed_[k][a]) values[static_cast<Eigen::Index>(3 * k + a)] = 0;
    }
  }
}

Eigen::VectorXd DofMap::restrict(const Eigen::Matrix3Xd& field) const {
  Eigen::VectorXd values(dof_count());
  const Eigen::Index couplings = (free_count_ - first_coupling_) / 2;
  using Six = Eigen::Matrix<double, 6, 6>;
  std::vector<Six> matrices(has_rigid_couplings() ? static_cast<std::size_t>(couplings) : 0,
                            Six::Zero());
  if (has_rigid_couplings()) values.tail(6 * couplings).setZero();
  for (std::int32_t k = 0; k < node_count(); ++k) {
    if (index(k) >= 0) values.segment<3>(3 * static_cast<Eigen::Index>(index(k))) = field.col(k);
    if (coupling(k) < 0) continue;
    const Eigen::Matrix<double, 3, 6> motion = rigid_motions_at(arm_m(k));
    matrices[static_cast<std::size_t>(coupling(k))] += motion.transpose() * motion;
    values.segment<6>(3 * static_cast<Eigen::Index>(translation(coupling(k)))) +=
        motion.transpose() * field.col(k);
  }
  for (std::size_t t = 0; t < matrices.size(); ++t) {
    auto six =
        values.segment<6>(3 * static_cast<Eigen::Index>(translation(static_cast<std::int32_t>(t))));
    six = matrices[t].ldlt().solve(Eigen::Matrix<double, 6, 1>(six)).eval();
  }
  clear_fixed(values);
  return values;
}

Eigen::Matrix3Xd DofMap::expand(const Eigen::VectorXd& free_values) const {
  Eigen::Matrix3Xd field = Eigen::Matrix3Xd::Zero(3, node_count());
  for (std::size_t k = 0; k < indices_.size(); ++k) {
    if (indices_[k] < 0) continue;
    auto displacement = field.col(static_cast<Eigen::Index>(k));
    displacement = free_values.segment<3>(3 * indices_[k]);
    for (Eigen::Index a = 0; a < 3; ++a) {
      if (is_fixed(indices_[k], a)) displacement[a] = 0;
    }
  }
  for (std::int32_t k = 0; has_rigid_couplings() && k < node_count(); ++k) {
    if (coupling(k) < 0) continue;
    const Eigen::Vector3d turn = free_values.segment<3>(3 * rotation(coupling(k)));
    field.col(k) = free_values.segment<3>(3 * translation(coupling(k))) + turn.cross(arm_m(k));
  }
  return field;
}

Eigen::VectorXd DofMap::gather(const Eigen::Matrix3Xd& forces) const {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(dof_count());
  for (std::size_t k = 0; k < indices_.size(); ++k) {
    if (indices_[k] < 0) continue;
    values.segment<3>(3 * indices_[k]) += forces.col(static_cast<Eigen::Index>(k));
  }
  for (std::int32_t k = 0; has_rigid_couplings() && k < node_count(); ++k) {
    if (coupling(k) < 0) continue;
    const Eigen::Vector3d force = forces.col(k);
    values.segment<3>(3 * translation(coupling(k))) += force;
    values.segment<3>(3 * rotation(coupling(k))) += arm_m(k).cross(force);
  }
  clear_fixed(values);
  return values;
}

}  // namespace flexneck::fe_modal
