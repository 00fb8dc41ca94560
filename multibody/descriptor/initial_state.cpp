// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/descriptor/initial_state.h"

#include <algorithm>

#include "multibody/descriptor/projection.h"

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

void check_all_positions(const Model& model, const EquationsOfMotion& equations) {
  for (std::size_t k = 0; k < model.joints.size(); ++k) {
    const JointRows& joint = equations.joint(k);
    check_positions(model, k, violation(joint, joint.position_residual), equations.system().size_m);
  }
}

void check_all_velocities(const Model& model, const EquationsOfMotion& equations) {
  const double size = equations.system().size_m;
  double speed = 0;
  for (const Joint& joint : model.joints)
    for (const std::size_t marker : {joint.marker_i, joint.marker_j}) {
      const NodeKinematics& motion = equations.marker(marker);
      speed = std::max({speed, motion.pd.norm(), size * motion.Om.norm()});
    }
  for (std::size_t k = 0; k < model.joints.size(); ++k) {
    const JointRows& joint = equations.joint(k);
    check_velocities(model, k, violation(joint, joint.velocity_residual), size, speed);
  }
}

}  // namespace

VectorXd given_state(const Model& model, const System& system) {
  VectorXd state = VectorXd::Zero(system.state_count());
  for (const FreeBody& free : system.bodies) {
    const Body& body = model.bodies[free.index];
    const Eigen::Quaterniond& q = body.initial_pose.rotation;
    state.segment<3>(free.position) = body.initial_pose.position_m;
    state.segment<4>(free.position + 3) << q.w(), q.x(), q.y(), q.z();
    const Index velocity = system.position_count + free.velocity;
    if (const auto* const deformable = std::get_if<DeformableBody>(&body.kind)) {
      const Index m = free.constants.mode_count();
      state.segment(free.position + 7, m) = initial_modal(*deformable);
      state.segment(velocity + 6, m) = initial_modal_rate(*deformable);
    }
    state.segment<3>(velocity) = body.initial_velocity_m_s;
    state.segment<3>(velocity + 3) = body.initial_angular_velocity_rad_s;
  }
  system.normalise(state.head(system.position_count));
  return state;
}

void join(const Model& model, EquationsOfMotion& equations, VectorXd& state, Check check) {
  const System& system = equations.system();
  const auto velocities = state.segment(system.position_count, system.velocity_count);
  const double time_s = model.start.time_s;
  equations.set_positions(time_s, state.head(system.position_count));
  check_all_positions(model, equations);
  equations.set_velocities(velocities);
  if (check == Check::positions_and_velocities) check_all_velocities(model, equations);
  Projection(equations).apply(time_s, state);
}

VectorXd given_positions(const Model& model, EquationsOfMotion& equations) {
  VectorXd state = given_state(model, equations.system());
  join(model, equations, state, Check::positions);
  return state.head(equations.system().position_count);
}

}  // namespace flexneck::multibody
