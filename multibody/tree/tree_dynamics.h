// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "multibody/equations/force_set.h"
#include "multibody/model/motion_state.h"
#include "multibody/tree/tree.h"

namespace flexneck::multibody::tree {

/// The equations of motion of a tree in joint coordinates, equations.md section 7: articulated-body
/// recursion with the modal coordinates of each body eliminated in the body. Work and memory grow
/// with the number of bodies. Owns the workspace: after construction nothing is allocated. Call
/// update, then solve.
class TreeDynamics {
 public:
  using ConstVector = Eigen::Ref<const Eigen::VectorXd>;

  /// @param tree  must outlive this
  explicit TreeDynamics(const Tree& tree, Drive drive = Drive::prescribed);

  /// Restricts the reading of tables to this interval: a jump at its ends then shows its inner
  /// side.
  void set_interval(double begin_s, double end_s);
  /// Required results: `motion` leaves out the moments in joints that fix bodies to prescribed ones
  /// that do not rotate (TreeBody::rides). No motion depends on them.
  enum class Purpose { motion, reactions };

  // These choose the internal variables of force elements for update(); see ForceSet.
  void relax() { forces_.relax(); }
  void give_internal(const ConstVector& state) { forces_.give_internal(tree_.internal(state)); }
  void begin_step(const ConstVector& state, const ConstVector& rate, double length_s) {
    forces_.begin_step(tree_.internal(state), tree_.internal(rate), length_s);
  }
  void follow_step() { forces_.follow_step(); }

  /// Updates positions and velocities of all bodies and markers, inertia and loads.
  void update(double time_s, const ConstVector& state, Purpose purpose = Purpose::reactions);
  /// Solves for accelerations and joint reactions.
  void solve();
  /// Computes the rate of the whole state (Tree::state_count()), for the purpose of motion.
  void evaluate(double time_s, const ConstVector& state, Eigen::VectorXd& rate);
  /// Fills in the rate of an updated state from given accelerations; powers are those of the last
  /// solve().
  void fill_rate(const ConstVector& state, const ConstVector& accelerations,
                 Eigen::VectorXd& rate) const;
  /// Generalised forces in addition to the model's, (velocity_count); zero unless set.
  Eigen::VectorXd& extra_forces() { return extra_forces_; }

  const Tree& tree() const { return tree_; }
  /// Accelerations, (velocity_count), after solve().
  const Eigen::VectorXd& accelerations() const { return accelerations_; }
  BodyState body_state(std::size_t body) const;
  /// Computes the motion of a marker; its accelerations are valid only after solve().
  void marker_state(std::size_t marker, MarkerState& state);
  /// Reaction of the model's joint, after solve().
  Reaction joint_reaction(std::size_t joint) const;
  /// Rotation from the axes of the joint's marker i to the world.
  Eigen::Matrix3d joint_axes(std::size_t joint) const;
  const Eigen::VectorXd& modal(std::size_t body) const { return work_[body].a; }
  Energies energies() const;
  const ForceSet& forces() const { return forces_; }
  double dissipation_W() const;
  /// Power of forces and prescribed bodies, after solve().
  double work_W() const;
  int evaluations() const { return evaluations_; }

 private:
  /// A frame's motion, all vectors except x in its own axes; acc is less gravity.
  struct Frame {
    Eigen::Matrix3d A = Eigen::Matrix3d::Identity();
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    Eigen::Vector3d v = Eigen::Vector3d::Zero();
    Eigen::Vector3d w = Eigen::Vector3d::Zero();
    Vector6d acceleration = Vector6d::Zero();  ///< acc above wdot
  };
  struct Work {
    explicit Work(const TreeBody& body);
    Frame frame;
    Eigen::VectorXd a, a_rate, a_acceleration;
    NodeMotion inner, outer;
    JointMotion joint;
    Eigen::Matrix3d R;  ///< body axes to the carrier's
    Eigen::Vector3d d;  ///< F to M, carrier's axes
    Matrix6d S;         ///< S of the joint, in body axes
    Vector6d inner_bias = Vector6d::Zero();
    Vector6d outer_bias = Vector6d::Zero();
    Vector6d joint_bias = Vector6d::Zero();
    InertiaTerms terms;  ///< becomes articulated in the inward pass
    Matrix6Xd coupling;  ///< (6, m): M_ra seen from M, then Y^T
    Eigen::VectorXd z;   ///< L^-1 of the modal bias
    Matrix6d inertia;    ///< at M, modes eliminated
    Vector6d bias;
    Matrix6d U;         ///< inertia S
    Matrix6d D;         ///< factor of S^T U
    Vector6d residual;  ///< tau - S^T bias
    Matrix6d inverse;   ///< inverse inertia of a body alone

    /// Force above moment at M on this body, body axes: the load for the acceleration of its
    /// articulated inertia.
    Vector6d reaction() const;
  };

  double table_time(double time_s) const;
  const Frame& frame_of(const Carrier& carrier) const;
  void update_prescribed_bodies();
  void update_body(const TreeBody& body, Work& work, const ConstVector& state, Purpose purpose);
  void update_alone(const TreeBody& body, Work& work, const ConstVector& state);
  void apply_forces();
  void apply(const TreeMarker& marker, const NodeMotion& node, const Eigen::Vector3d& force,
             const Eigen::Vector3d& torque);
  void eliminate_modes(const TreeBody& body, Work& work);
  void eliminate_joint(const TreeBody& body, Work& work);
  void pass_inwards(const TreeBody& body, Work& work);
  void pass_inwards_from_rigid_end(const TreeBody& body, Work& work);
  void accelerate(const TreeBody& body, Work& work);
  void accelerate_alone(const TreeBody& body, Work& work);

  const Tree& tree_;
  Drive drive_;
  Eigen::Vector3d gravity_;
  double interval_begin_s_;
  double interval_end_s_;
  double time_s_ = 0;
  Frame world_;
  std::vector<Frame> prescribed_;
  std::vector<Work> work_;
  std::vector<NodeMotion> marker_nodes_;
  ForceSet forces_;
  Eigen::VectorXd extra_forces_, accelerations_;
  int evaluations_ = 0;
};

}  // namespace flexneck::multibody::tree
