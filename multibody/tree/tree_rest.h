// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "multibody/numerics/rest.h"
#include "multibody/tree/tree_dynamics.h"

namespace flexneck::multibody::tree {

/// The equilibrium search in a tree's own coordinates: displacements N xi of the joints and modes
/// with N N^T = M^-1.
class TreeRest final : public RestProblem {
 public:
  /// @param dynamics  with Drive::held; must outlive this
  /// @param state     at rest
  /// @param time_s    time of the forces and the prescribed bodies' positions
  TreeRest(TreeDynamics& dynamics, const Eigen::VectorXd& state, double time_s = 0);

  Eigen::Index count() const override { return N_.cols(); }
  double extent(const Eigen::VectorXd& xi) const override;
  Eigen::VectorXd forces_at(const Eigen::VectorXd& xi) override;
  double energy() const override;
  Eigen::MatrixXd stiffness() override;
  void move_to(const Eigen::VectorXd& xi) override;

  const Eigen::VectorXd& state() const { return state_; }

 private:
  Eigen::VectorXd state_at(const Eigen::VectorXd& xi) const;
  void update_basis();

  TreeDynamics& dynamics_;
  Eigen::VectorXd state_;
  double time_s_;
  Eigen::MatrixXd N_;  ///< lower triangular
};

}  // namespace flexneck::multibody::tree
