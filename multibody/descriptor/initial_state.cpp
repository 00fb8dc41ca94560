// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/descriptor/initial_state.h"

#include <algorithm>

#include "geometry/foundation/error.h"
#include "multibody/descriptor/mobility.h"
#include "multibody/descriptor/projection.h"

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void check_all_positions(const Model& model, const EquationsOfMotion& equations) {
  for (std::size_t k = 0; k < model.joints.size(); ++k) {
    const JointRows& joint = equations.joint(k);
    check_positions(model, k, violation(joint, joint.position_residual), equations.system().size_m);
  }
}

/// Largest speed of a marker of a joint.
double largest_speed(const EquationsOfMotion& equations) {
  const double size = equations.system().size_m;
  double speed = 0;
  for (const Joint& joint : equations.system().joints)
    for (const std::size_t marker : {joint.marker_i, joint.marker_j}) {
      const NodeKinematics& motion = equations.marker(marker);
      speed = std::max({speed, motion.pd.norm(), size * motion.Om.norm()});
    }
  return speed;
}

bool all_velocities_fit(const EquationsOfMotion& equations) {
  const double speed = largest_speed(equations);
  for (std::size_t k = 0; k < equations.system().joints.size(); ++k) {
    const JointRows& joint = equations.joint(k);
    if (!velocities_fit(violation(joint, joint.velocity_residual), equations.system().size_m,
                        speed))
      return false;
  }
  return true;
}

void check_all_velocities(const Model& model, const EquationsOfMotion& equations) {
  if (all_velocities_fit(equations)) return;
  const std::string motors = contradictory_motors(equations);
  if (!motors.empty()) throw InputError("at the start " + motors);
  const double speed = largest_speed(equations);
  for (std::size_t k = 0; k < model.joints.size(); ++k) {
    const JointRows& joint = equations.joint(k);
    check_velocities(model, k, violation(joint, joint.velocity_residual), equations.system().size_m,
                     speed);
  }
}

/// Makes the open velocities satisfy the joints by the smallest change in the mass metric; given
/// velocities are not changed.
void fit_open_velocities(const Model& model, EquationsOfMotion& equations,
                         Eigen::Ref<VectorXd> velocities) {
  const System& system = equations.system();
  const auto first_given = [&](std::size_t body) {
    return model.bodies[system.bodies[body].index].velocities_are_open ? Index{6} : Index{0};
  };
  KktSolver solver(system.body_sizes(), system.places, system.velocity_lengths_m());
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    MatrixXd mass = equations.body(b).mass;
    const Index given = mass.rows() - first_given(b);
    mass.bottomRows(given).setZero();
    mass.rightCols(given).setZero();
    mass.bottomRightCorner(given, given).setIdentity();
    solver.set_mass(b, mass);
  }
  for (std::size_t k = 0; k < system.joints.size(); ++k) {
    JointRows rows = equations.joint(k);
    const auto hold = [&](std::size_t body, TransposedRows& of) {
      if (body != JointPlace::kNoBody) of.bottomRows(of.rows() - first_given(body)).setZero();
    };
    hold(system.places[k].body_i, rows.B_i);
    hold(system.places[k].body_j, rows.B_j);
    solver.set_rows(k, rows);
  }
  solver.factorise();
  VectorXd change = VectorXd::Zero(system.velocity_count);
  VectorXd rates = -equations.velocity_residual();
  solver.solve(change, rates);
  velocities += change;
  equations.set_velocities(velocities);
}

/// Sets positions and velocities of the equations.
void set_fitting(const Model& model, EquationsOfMotion& equations, VectorXd& state) {
  const System& system = equations.system();
  auto velocities = state.segment(system.position_count, system.velocity_count);
  equations.set_positions(model.start.time_s, state.head(system.position_count));
  equations.set_velocities(velocities);
  const bool any_open = std::any_of(model.bodies.begin(), model.bodies.end(),
                                    [](const Body& body) { return body.velocities_are_open; });
  if (any_open && !all_velocities_fit(equations)) fit_open_velocities(model, equations, velocities);
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
  const double time_s = model.start.time_s;
  equations.set_positions(time_s, state.head(equations.system().position_count));
  check_all_positions(model, equations);
  if (check == Check::positions_and_velocities) {
    set_fitting(model, equations, state);
    check_all_velocities(model, equations);
  }
  Projection(equations).apply(time_s, state);
}

std::vector<VectorXd> fitting_velocities(const Model& model) {
  const System system(model);
  EquationsOfMotion equations(system);
  VectorXd state = given_state(model, system);
  set_fitting(model, equations, state);
  std::vector<VectorXd> velocities(model.bodies.size());
  for (const FreeBody& body : system.bodies)
    velocities[body.index] =
        state.segment(system.position_count + body.velocity, body.constants.velocity_count());
  return velocities;
}

VectorXd given_positions(const Model& model, EquationsOfMotion& equations) {
  VectorXd state = given_state(model, equations.system());
  join(model, equations, state, Check::positions);
  return state.head(equations.system().position_count);
}

}  // namespace flexneck::multibody
