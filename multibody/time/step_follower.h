// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <Eigen/Core>

#include "multibody/equations/equations.h"
#include "multibody/history/run_watch.h"
#include "multibody/time/time_integrator.h"

namespace flexneck::multibody {

/// Follows a run from accepted step to accepted step for the objects that must see each of them:
/// guards and angles with counted turns.
class StepFollower {
 public:
  /// @param equations, watch  must outlive this
  StepFollower(Equations& equations, RunWatch& watch) : equations_(equations), watch_(watch) {}

  /// Starts at the beginning of a run, or where a run is resumed.
  void begin(double time_s, const Eigen::VectorXd& state);
  /// Follows the integrator after a step.
  /// @param record_until  called with increasing times up to the end of the step, so that records
  /// that use the watch are made in the order of time
  /// @throws ComputationError of a guard that ends the run.
  void follow(const TimeIntegrator& integrator,
              const std::function<void(double time_s)>& record_until);

 private:
  void look(double time_s, const Eigen::VectorXd& state);

  Equations& equations_;
  RunWatch& watch_;
  double begin_s_ = 0;
  Eigen::VectorXd inside_;
};

}  // namespace flexneck::multibody
