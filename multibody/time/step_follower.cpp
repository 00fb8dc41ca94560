// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/time/step_follower.h"

namespace flexneck::multibody {

void StepFollower::begin(double time_s, const Eigen::VectorXd& state) {
  begin_s_ = time_s;
  inside_ = state;
  look(time_s, state);
  equations_.accept(time_s, state, watch_);
}

void StepFollower::look(double time_s, const Eigen::VectorXd& state) {
  if (watch_.markers().empty()) return;
  equations_.show(time_s, state, watch_);
  watch_.look(time_s);
}

void StepFollower::follow(const TimeIntegrator& integrator,
                          const std::function<void(double time_s)>& record_until) {
  const double end_s = integrator.time_s();
  int looks = 1;
  if (!watch_.markers().empty()) {
    equations_.show(end_s, integrator.state(), watch_);
    looks = watch_.looks_until(end_s);
  }
  for (int k = 1; k < looks; ++k) {
    const double time_s = begin_s_ + (end_s - begin_s_) * k / looks;
    record_until(time_s);
    integrator.interpolate(time_s, inside_);
    look(time_s, inside_);
  }
  record_until(end_s);
  look(end_s, integrator.state());
  equations_.accept(end_s, integrator.state(), watch_);
  begin_s_ = end_s;
}

}  // namespace flexneck::multibody
