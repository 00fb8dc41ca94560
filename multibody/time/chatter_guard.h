// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "multibody/equations/equations.h"
#include "multibody/time/time_integrator.h"

namespace flexneck::multibody {

/// Detects a run that does not advance because a function force jumps back and forth, such as
/// friction written as the sign of a velocity: if both sides of the jump lead back to it, no step
/// is short enough.
class ChatterGuard {
 public:
  /// @param equations  must outlive this
  explicit ChatterGuard(Equations& equations);

  /// Checks for chatter after each accepted step, whose end was evaluated last.
  /// @throws ComputationError naming the force, the time and a remedy.
  void check(const TimeIntegrator& integrator);

 private:
  using Load = Eigen::Matrix<double, 6, 1>;

  /// Copies the loads of all function forces, as evaluated last.
  void take(double time_s, std::vector<Load>& loads) const;
  std::string name_of(std::size_t force) const;
  bool jumps(const TimeIntegrator& integrator, std::size_t force);

  Equations& equations_;
  std::vector<Load> last_, now_;  ///< at the ends of the step before and of this one
  std::vector<int> turn_overs_;   ///< number of reversals among the counted steps
  int steps_ = 0;
  double last_time_s_ = 0;
  Eigen::VectorXd state_, rate_;
};

}  // namespace flexneck::multibody
