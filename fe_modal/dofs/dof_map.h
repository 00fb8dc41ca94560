// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Nodes that move as one rigid body, u = t + theta x (x - point).
struct RigidCoupling {
  std::string name;  ///< for messages
  std::vector<std::int32_t> nodes;
  Eigen::Vector3d point_m;
};

/// Nodes that are fixed in some of the mesh's directions only.
struct FixedDirections {
  std::vector<std::int32_t> nodes;
  std::array<bool, 3> is_fixed;  ///< in x, y, z
};

/// Numbers the nodes that may move; fixed ones have no degrees of freedom, and nodes tied to one
/// another share theirs. Degree of freedom 3 index(k) + a is direction a of node k. Keeps the order
/// of the nodes. After them come two numbers for each rigid coupling: its translation t and its
/// rotation theta take the places of two nodes. A direction that is fixed alone keeps its number,
/// and is zero.
class DofMap {
 public:
  /// @param fixed nodes fixed in all directions, in range; a node tied to one of them is fixed too
  /// @param slits those that are tied couple their pairs
  DofMap(std::size_t node_count, std::span<const std::int32_t> fixed,
         std::span<const mesher::Slit> slits = {});
  /// @param couplings a node tied to one of theirs, by a slit, is in the coupling too
  /// @throws InputError if a rigid coupling has a node that is fixed, in any direction, or shares
  /// one with another.
  DofMap(const mesher::Mesh& mesh, std::span<const std::int32_t> fixed,
         std::span<const RigidCoupling> couplings = {},
         std::span<const FixedDirections> directions = {});

  /// The same of some nodes alone, by numbers of their own, which ascend as those of the whole do.
  /// @param nodes of the whole, ascending
  /// @param numbers takes what the numbers are in the whole
  DofMap part(std::span<const std::int32_t> nodes, std::vector<std::int32_t>& numbers) const;

  Eigen::Index node_count() const { return static_cast<Eigen::Index>(indices_.size()); }
  Eigen::Index free_count() const { return free_count_; }
  Eigen::Index dof_count() const { return 3 * free_count_; }

  /// Number of a node among the free ones, -1 if it is fixed or in a rigid coupling.
  std::int32_t index(std::int32_t node) const { return indices_[static_cast<std::size_t>(node)]; }
  bool has_rigid_couplings() const { return !coupling_of_.empty(); }
  /// Number of a node's rigid coupling, -1 if it is in none.
  std::int32_t coupling(std::int32_t node) const {
    return has_rigid_couplings() ? coupling_of_[static_cast<std::size_t>(node)] : -1;
  }
  /// Numbers of a rigid coupling's translation, m, and rotation, rad.
  std::int32_t translation(std::int32_t coupling) const { return first_coupling_ + 2 * coupling; }
  std::int32_t rotation(std::int32_t coupling) const { return first_coupling_ + 2 * coupling + 1; }
  /// Calls emit(number) for each number that a node's displacement depends on.
  template <typename Emit>
  void for_each_number(std::int32_t node, const Emit& emit) const {
    if (coupling(node) >= 0) {
      emit(translation(coupling(node)));
      emit(rotation(coupling(node)));
    } else if (index(node) >= 0) {
      emit(index(node));
    }
  }
  /// Whether a node, by its number, is fixed in direction a.
  bool is_fixed(std::int32_t number, Eigen::Index a) const {
    return !fixed_.empty() && fixed_[static_cast<std::size_t>(number)][static_cast<std::size_t>(a)];
  }
  Eigen::Index fixed_direction_count() const;
  /// Whether some degrees of freedom are not those of a node that moves freely.
  bool is_constrained() const { return has_rigid_couplings() || !fixed_.empty(); }
  /// From the point of its rigid coupling to a node.
  Eigen::Vector3d arm_m(std::int32_t node) const { return arms_m_.col(node); }
  /// What a field on all nodes, (3, n), has as free values: of a coupling, whose nodes need not
  /// quite move rigidly in it, the least-squares motion.
  Eigen::VectorXd restrict(const Eigen::Matrix3Xd& field) const;

  /// Field on all nodes, (3, n), from its free values (dof_count()); zero on fixed nodes.
  Eigen::Matrix3Xd expand(const Eigen::VectorXd& free_values) const;
  /// Forces on the free degrees of freedom from forces on all nodes, (3, n): the transpose of
  /// expand(). Forces on tied nodes add.
  Eigen::VectorXd gather(const Eigen::Matrix3Xd& forces) const;

 private:
  DofMap() = default;
  void couple_rigidly(const mesher::Mesh& mesh, std::span<const RigidCoupling> couplings);
  void fix(std::span<const FixedDirections> directions, std::span<const RigidCoupling> couplings);
  /// Zero in the directions that are fixed, (dof_count()).
  void clear_fixed(Eigen::VectorXd& values) const;

  std::vector<std::int32_t> indices_;
  Eigen::Index free_count_ = 0;
  std::int32_t first_coupling_ = 0;
  std::vector<std::int32_t> coupling_of_;   ///< (n), empty without rigid couplings
  Eigen::Matrix3Xd arms_m_;                 ///< (3, n), likewise
  std::vector<std::array<bool, 3>> fixed_;  ///< (free_count), empty without fixed directions
};

}  // namespace flexneck::fe_modal
