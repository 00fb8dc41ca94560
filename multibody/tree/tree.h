// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "multibody/equations/force_set.h"
#include "multibody/model/model.h"
#include "multibody/model/prescribed_path.h"
#include "multibody/tree/body_inertia.h"
#include "multibody/tree/tree_joint.h"
#include "multibody/tree/tree_node.h"

namespace flexneck::multibody::tree {

inline constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// Carrier of a body, a marker or a node: a body of the tree, a prescribed one or the world.
struct Carrier {
  std::size_t body = kNone;        ///< index in the tree's order, or
  std::size_t prescribed = kNone;  ///< among the prescribed bodies; the world if neither
};

/// A body, and the joint that connects it with its carrier in the tree.
struct TreeBody {
  std::string name;
  std::size_t index;  ///< index among the model's bodies
  BodyInertia inertia;
  Carrier carrier;
  std::size_t joint_index = kNone;  ///< index among the model's joints; kNone if the body floats
  bool inner_is_i = true;           ///< the joint's marker i is the carrier's
  TreeJoint joint;
  TreeNode inner;         ///< F, on the carrier
  TreeNode outer;         ///< M, on this body
  Eigen::Index position;  ///< start of the joint's coordinates, then the modes', in the positions
  Eigen::Index velocity;  ///< start of their rates in the velocities
  /// True if it is rigid, fixed to its carrier and without outer bodies: its articulated inertia is
  /// its own, and constant.
  bool is_rigid_end = false;
  /// True if it is rigid, without joint and outer bodies: its motion follows from its loads alone.
  bool is_alone = false;
  /// True if it is fixed to a prescribed body that never rotates: the inertia of its own frame then
  /// affects nothing but the reaction of that joint.
  bool rides = false;

  bool is_fixed() const { return joint.is_fixed(); }
};

struct TreeMarker {
  TreeNode node;
  Carrier carrier;
};

/// A model as trees of bodies in joint coordinates. Its state is y = [q; u; z; e]: for each body in
/// the tree's order, inner ones first, its joint's coordinates (TreeJoint) and its modal ones, then
/// their rates, then internal variables of the force elements and two quadratures: the energy that
/// damping has dissipated and the work of forces and prescribed bodies.
struct Tree {
  static constexpr Eigen::Index kQuadratures = 2;

  /// @param model  sound (see check()); must outlive this
  /// @throws InputError naming the joint that closes a loop.
  explicit Tree(const Model& model);

  const Model& model;
  std::vector<TreeBody> bodies;
  std::vector<PrescribedPath> prescribed;
  std::vector<TreeMarker> markers;         ///< by the model's markers
  std::vector<std::size_t> body_of_joint;  ///< outer body of each joint of the model; kNone if free
  Eigen::Index position_count = 0;
  Eigen::Index velocity_count = 0;
  Eigen::Index internal_count = 0;
  std::vector<InternalBlock> internal_blocks;
  /// Largest distance within a body, from its origin to a joint, or its radius; one if all are
  /// points.
  double size_m = 0;

  Eigen::Index state_count() const {
    return position_count + velocity_count + internal_count + kQuadratures;
  }
  /// The internal variables in a state.
  template <class State>
  auto internal(State&& state) const {
    return state.segment(position_count + velocity_count, internal_count);
  }
};

/// The angle of a joint that has one, of marker j relative to i, with turns counted by a state's
/// coordinate.
double joint_angle_rad(const Tree& tree, std::size_t joint,
                       const Eigen::Ref<const Eigen::VectorXd>& state);

/// Moves positions by a finite displacement with the components of velocities, (velocity_count).
void retract(const Tree& tree, const Eigen::Ref<const Eigen::VectorXd>& change,
             Eigen::Ref<Eigen::VectorXd> positions);

/// Returns whether the joints of a model form trees.
bool is_tree(const Model& model);

}  // namespace flexneck::multibody::tree
