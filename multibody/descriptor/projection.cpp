// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/descriptor/projection.h"

#include <limits>

namespace flexneck::multibody {

using Eigen::VectorXd;

Projection::Projection(EquationsOfMotion& equations)
    : equations_(equations), change_(VectorXd::Zero(equations.system().velocity_count)) {}

void Projection::correct_positions(Segment& positions) {
  equations_.remove_residual(equations_.position_residual(), change_);
  equations_.system().retract(positions, change_);
}

void Projection::step_positions(double time_s, Segment& positions) {
  if (equations_.system().constraint_count == 0) return;
  correct_positions(positions);
  equations_.update_positions(time_s, positions);
}

void Projection::correct_velocities(Segment& velocities) {
  if (equations_.system().constraint_count > 0) {
    equations_.update_velocity_residual(velocities);
    equations_.remove_residual(equations_.velocity_residual(), change_);
    velocities += change_;
  }
  equations_.set_velocities(velocities);
}

void Projection::apply(double time_s, Segment state, bool refactorise) {
  const System& system = equations_.system();
  Segment positions = state.head(system.position_count);
  Segment velocities = state.segment(system.position_count, system.velocity_count);
  system.normalise(positions);
  equations_.set_positions(time_s, positions);
  step_positions(time_s, positions);
  if (refactorise && system.constraint_count > 0) equations_.factorise();
  correct_velocities(velocities);
}

void Projection::apply_behind_step(double time_s, Segment state) {
  const System& system = equations_.system();
  Segment positions = state.head(system.position_count);
  Segment velocities = state.segment(system.position_count, system.velocity_count);
  system.normalise(positions);
  equations_.update_positions(time_s, positions);
  step_positions(time_s, positions);
  equations_.factorise();
  correct_velocities(velocities);
}

double Projection::converge_positions(double time_s, Segment positions) {
  constexpr int kMaxSteps = 10;
  equations_.system().normalise(positions);
  equations_.set_positions(time_s, positions);
  if (equations_.system().constraint_count == 0) return 0;
  double residual = equations_.position_residual().lpNorm<Eigen::Infinity>();
  for (int step = 0; step < kMaxSteps && residual > 0; ++step) {
    const VectorXd before = positions;
    correct_positions(positions);
    equations_.set_positions(time_s, positions);
    const double reduced = equations_.position_residual().lpNorm<Eigen::Infinity>();
    if (!(reduced < residual)) {
      positions = before;
      equations_.set_positions(time_s, positions);
      break;
    }
    residual = reduced;
  }
  return residual;
}

}  // namespace flexneck::multibody
