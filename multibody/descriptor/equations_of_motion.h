// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "multibody/descriptor/joints.h"
#include "multibody/descriptor/kkt_solver.h"
#include "multibody/descriptor/node_kinematics.h"
#include "multibody/descriptor/system.h"
#include "multibody/equations/force_set.h"

namespace flexneck::multibody {

/// Evaluates the equations of motion, equations.md (8)-(13) and section 5, of a system. Owns the
/// workspace: after construction nothing is allocated. Call set_positions, then
/// set_velocities, then solve.
class EquationsOfMotion {
 public:
  using ConstVector = Eigen::Ref<const Eigen::VectorXd>;

  /// @param system  must outlive this
  explicit EquationsOfMotion(const System& system, Drive drive = Drive::prescribed);

  /// Restricts the reading of tables to this interval: a jump at its ends then shows its inner
  /// side.
  void set_interval(double begin_s, double end_s);

  /// Updates the configuration, mass matrices and constraint rows, and factorises.
  void set_positions(double time_s, const ConstVector& positions);
  /// As set_positions(), without the factors: solutions use those of the last factorised
  /// configuration.
  void update_positions(double time_s, const ConstVector& positions);
  void factorise();
  /// Updates the velocity residuals alone.
  void update_velocity_residual(const ConstVector& velocities);
  /// Updates right-hand sides and velocity residuals.
  void set_velocities(const ConstVector& velocities);
  /// Solves for accelerations and multipliers.
  void solve();
  // These choose the internal variables of force elements for set_velocities(); see ForceSet.
  void relax() { forces_.relax(); }
  void give_internal(const ConstVector& state) { forces_.give_internal(system_.internal(state)); }
  void begin_step(const ConstVector& state, const ConstVector& rate, double length_s) {
    forces_.begin_step(system_.internal(state), system_.internal(rate), length_s);
  }

  /// Computes the rate of the whole state (System::state_count()) by all three steps.
  void evaluate(double time_s, const ConstVector& state, Eigen::VectorXd& rate);
  /// As evaluate(), with positions and velocities already updated.
  void evaluate_updated(const ConstVector& state, Eigen::VectorXd& rate);
  /// Fills in the rate of an updated state from known accelerations and multipliers.
  void fill_rate(const ConstVector& state, const ConstVector& accelerations,
                 Eigen::VectorXd& rate) const;

  /// Residual of the equations of motion for given accelerations and multipliers, M V' + B^T lambda
  /// - u, above the position residual of the constraints, at the end of the step of begin_step().
  /// Nothing is factorised.
  void residual(double time_s, const ConstVector& state, const ConstVector& accelerations,
                const ConstVector& multipliers, Eigen::VectorXd& residual);

  /// Solves [M B^T; B 0] [change; .] = [0; -residual]: the smallest change in the mass metric.
  void remove_residual(const Eigen::VectorXd& residual, Eigen::VectorXd& change);
  /// Marks the velocities that the constraints of the last factorisation determine, body by body.
  void given_velocities(std::vector<bool>& given);
  /// Updates markers that neither joint nor force touches, after set_velocities().
  void update_idle_markers(const ConstVector& velocities);

  const System& system() const { return system_; }
  const Eigen::VectorXd& accelerations() const { return accelerations_; }
  const Eigen::VectorXd& multipliers() const { return multipliers_; }
  const Eigen::VectorXd& right_hand_side() const { return right_hand_side_; }
  const Eigen::VectorXd& position_residual() const { return position_residual_; }
  const Eigen::VectorXd& velocity_residual() const { return velocity_residual_; }
  const BodyTerms& body(std::size_t index) const { return bodies_[index]; }
  const std::vector<PrescribedMotion>& prescribed() const { return prescribed_; }
  const NodeKinematics& marker(std::size_t index) const { return markers_[index]; }
  const JointRows& joint(std::size_t index) const { return joints_[index]; }
  const KktSolver& solver() const { return solver_; }
  Reaction joint_reaction(std::size_t joint) const;
  const ForceSet& forces() const { return forces_; }
  /// The angle of a joint that has one, in the present motion, continued from the last count of
  /// turns.
  CountedAngle joint_angle(std::size_t joint) const;
  /// Counts turns up to the present motion. Before the first count a joint's angle starts at the
  /// model's start angle.
  void count_turns();
  /// Copies the counted turns from another object of the same system.
  void take_turns(const EquationsOfMotion& other);
  /// Power dissipated; needs the multipliers of solve().
  double dissipation_W(const ConstVector& velocities) const;
  double work_W() const;
  int evaluations() const { return evaluations_; }

 private:
  double table_time(double time_s) const;
  void update_prescribed_bodies();
  void follow_motor(CoordinateRow& row) const;
  void update_marker_configuration(std::size_t index);
  void update_marker_velocities(std::size_t index, const ConstVector& velocities);
  void update_joint_velocities();
  void apply_forces();

  const System& system_;
  Drive drive_;
  double interval_begin_s_;
  double interval_end_s_;
  double time_s_ = 0;
  std::vector<BodyTerms> bodies_;
  std::vector<PrescribedMotion> prescribed_;
  std::vector<NodeKinematics> markers_;
  std::vector<std::size_t> active_markers_, idle_markers_;
  std::vector<JointRows> joints_;
  ForceSet forces_;
  KktSolver solver_;
  Eigen::VectorXd right_hand_side_, gamma_;
  Eigen::VectorXd position_residual_, velocity_residual_;
  Eigen::VectorXd accelerations_, multipliers_;
  Eigen::VectorXd scratch_;
  Eigen::VectorXd probe_, lengths_m_;  ///< for given_velocities()
  int evaluations_ = 0;
};

}  // namespace flexneck::multibody
