// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <Eigen/Core>

namespace flexneck::multibody {

/// A system at rest with fixed prescribed bodies, in k coordinates xi about a present
/// configuration: the functions that a search for its equilibrium needs. In these coordinates the
/// mass matrix is the identity at xi = 0.
class RestProblem {
 public:
  virtual ~RestProblem() = default;
  virtual Eigen::Index count() const = 0;
  /// Largest displacement of a body by xi: a length in units of the system's size, or rad.
  virtual double extent(const Eigen::VectorXd& xi) const = 0;
  /// Accelerations of xi: minus the gradient of the potential energy.
  virtual Eigen::VectorXd forces_at(const Eigen::VectorXd& xi) = 0;
  /// Potential energy at the last forces_at(), J.
  virtual double energy() const = 0;
  /// Minus the gradient of the forces at xi = 0, (k, k).
  virtual Eigen::MatrixXd stiffness() = 0;
  /// Makes xi the present configuration.
  virtual void move_to(const Eigen::VectorXd& xi) = 0;
};

/// Moves to a minimum of the potential energy, sought from the present configuration.
/// @param moved  called after each move; may be empty
/// @throws ComputationError if there is none within reach.
void find_equilibrium(RestProblem& rest, const std::function<void()>& moved = {});

}  // namespace flexneck::multibody
