// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/dofs/affine_constraints.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Numbers the degrees of freedom that remain under constraints, in blocks of three. Sites have
/// three each: the nodes of the mesh, then the translation and the rotation of each reference point
/// (mesher/mesh/connections.h). A site has a block if one of its degrees of freedom is independent;
/// nodes tied to one another share it. Blocks keep the order of the sites until renumber(). Degree
/// of freedom 3 block + a is direction a of its site; a dependent one keeps its place, without
/// stiffness or mass, and is zero.
class DofMap {
 public:
  /// @param fixed nodes fixed in all directions, in range; a node tied to one of them is fixed too
  /// @param slits slits of the mesh; the tied ones couple their pairs
  DofMap(std::size_t node_count, std::span<const std::int32_t> fixed,
         std::span<const mesher::Slit> slits = {});
  /// @throws InputError as AffineConstraints, and for a reference point with a mass and an
  /// unconstrained motion.
  DofMap(const mesher::Mesh& mesh, std::span<const std::int32_t> fixed,
         const mesher::Connections& connections);
  /// Uses the mesh's own connections.
  DofMap(const mesher::Mesh& mesh, std::span<const std::int32_t> fixed)
      : DofMap(mesh, fixed, mesh.connections) {}

  /// Renumbers the blocks in an order, a permutation of them: entry k becomes block k.
  void renumber(std::span<const std::int32_t> order);

  Eigen::Index node_count() const { return node_count_; }
  Eigen::Index site_count() const { return static_cast<Eigen::Index>(indices_.size()); }
  Eigen::Index free_count() const { return free_count_; }  ///< number of blocks
  Eigen::Index dof_count() const { return 3 * free_count_; }

  /// A site's own block, or that of the node to which it is tied in all directions; -1 if it has
  /// none.
  std::int32_t index(std::int32_t site) const { return indices_[static_cast<std::size_t>(site)]; }
  /// True if the site moves as the block index() does, or, without a block, is fixed.
  bool is_plain(std::int32_t site) const {
    return composite_of_.empty() || composite_of_[static_cast<std::size_t>(site)] < 0;
  }
  /// Direction a of a site that is not plain: coefficients times degrees of freedom of the blocks.
  std::span<const DofTerm> terms(std::int32_t site, int a) const;
  /// Calls visit(block) for the blocks that move a site; a block may be repeated.
  template <typename Visitor>
  void for_each_number(std::int32_t site, const Visitor& visit) const;

  /// True if some sites do not move as a free node does.
  bool is_constrained() const { return !composite_of_.empty(); }
  /// True if degree of freedom a of a block is dependent.
  bool is_dependent(std::int32_t block, Eigen::Index a) const {
    return !dependent_.empty() &&
           dependent_[static_cast<std::size_t>(block)][static_cast<std::size_t>(a)];
  }
  Eigen::Index dependent_count() const;

  /// Free values of a field on all nodes, (3, n): for a reference point the least-squares motion of
  /// the nodes that follow it; they need not follow it exactly in the field.
  Eigen::VectorXd restrict(const Eigen::Matrix3Xd& field) const;
  /// Field on all nodes, (3, n), from its free values (dof_count()); zero on fixed nodes.
  Eigen::Matrix3Xd expand(const Eigen::VectorXd& free_values) const;
  /// Displacement of one site from the free values.
  Eigen::Vector3d motion_of(std::int32_t site,
                            const Eigen::Ref<const Eigen::VectorXd>& free_values) const;
  /// Forces on the free degrees of freedom from forces on all nodes, (3, n): the transpose of
  /// expand(). Forces on tied nodes add.
  Eigen::VectorXd gather(const Eigen::Matrix3Xd& forces) const;
  /// Adds the force on one site; the moment if the site is a rotation.
  void add_force(std::int32_t site, const Eigen::Vector3d& force,
                 Eigen::Ref<Eigen::VectorXd> values) const;

 private:
  bool is_of_point(std::int32_t block) const {
    return !point_half_of_.empty() && point_half_of_[static_cast<std::size_t>(block)] >= 0;
  }
  void number(const AffineConstraints& constraints);
  void add_composite(const AffineConstraints& constraints, std::int32_t site);
  void fit_points(const Eigen::Matrix3Xd& field, Eigen::VectorXd& values) const;

  std::vector<std::int32_t> indices_;  ///< (sites)
  Eigen::Index node_count_ = 0;
  Eigen::Index free_count_ = 0;
  std::vector<std::int32_t> composite_of_;  ///< (sites), empty if all are plain
  /// Start of the terms of each direction of each composite.
  std::vector<std::size_t> offsets_ = {0};
  std::vector<DofTerm> terms_;
  std::vector<std::array<bool, 3>> dependent_;  ///< (free_count), empty if none is
  /// (free_count) for each block, twice the number of its reference point, plus one for a rotation;
  /// -1 for a node's block. Empty without points.
  std::vector<std::int32_t> point_half_of_;
};

template <typename Visitor>
void DofMap::for_each_number(std::int32_t site, const Visitor& visit) const {
  if (is_plain(site)) {
    if (index(site) >= 0) visit(index(site));
    return;
  }
  for (int a = 0; a < 3; ++a) {
    for (const DofTerm& term : terms(site, a)) visit(term.dof / 3);
  }
}

}  // namespace flexneck::fe_modal
