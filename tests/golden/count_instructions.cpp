// SPDX-License-Identifier: GPL-3.0-or-later
// Evaluations and outputs of the equations of motion, for callgrind to count
// (instructions_test.py). Each part has 20 or 40 of them, so that the difference of both is the
// cost of 20 without that of the first ones.
#include <cstdio>
#include <string>

#include "multibody/equations/equations.h"
#include "multibody/tree/tree_dynamics.h"
#include "tests/support/tree_models.h"

using namespace flexneck::multibody;
using Eigen::VectorXd;

namespace {

constexpr int kCount = 20;
constexpr double kStep_s = 1e-5;

/// callgrind begins a new part of its counts here (--dump-before).
extern "C" [[gnu::noinline]] void begin_part(const char* name) { std::puts(name); }

/// Evaluates while advancing the state a little, so that no state occurs twice.
void evaluate(Equations& equations, VectorXd state, int count) {
  VectorXd rate = VectorXd::Zero(state.size());
  for (int k = 0; k < count; ++k) {
    equations.derivative(k * kStep_s, state, rate);
    state += kStep_s * rate;
  }
}

void record(Equations& equations, const Model& model, const VectorXd& start, int count) {
  const OutputOptions output{count * kStep_s, kStep_s};
  Recorder recorder(model, output);
  VectorXd rate = VectorXd::Zero(start.size());
  equations.derivative(0, start, rate);
  VectorXd state = start;
  for (int k = 0; k < count; ++k) {
    state = start + k * kStep_s * rate;
    equations.record(k * kStep_s, state, recorder, k);
  }
}

void count(const std::string& name, const Model& model, Equations& equations) {
  const VectorXd start = equations.given_state();
  equations.set_interval(0, 1);
  for (const int times : {kCount, 2 * kCount}) {
    begin_part((name + ", evaluation: " + std::to_string(times)).c_str());
    evaluate(equations, start, times);
    begin_part((name + ", output: " + std::to_string(times)).c_str());
    record(equations, model, start, times);
  }
  begin_part("");
}

void count_both(const std::string& name, const Model& model) {
  const SolverOptions solver{.relative_tolerance = 1e-8, .absolute_tolerance = 1e-11};
  count(name + ", descriptor", model, *descriptor_equations(model, solver));
  count(name + ", recursive", model, *recursive_equations(model, solver));
}

Model head_on_neck() {
  using namespace flexneck::testing;
  ModelBuilder build =
      flexneck::testing::head_on_neck(PrescribedBody{}, hanging_pose(), Beam{}, 0.9, make_head());
  build.model.gravity_m_s2 = {0, 0, -kGravity};
  return build.model;
}

/// A model with every kind of body, joint and force, with joint coordinates of zero.
Model forest() {
  Model model = flexneck::testing::forest(true);
  const tree::Tree tree(model);
  tree::TreeDynamics dynamics(tree);
  VectorXd state = VectorXd::Zero(tree.state_count());
  for (const tree::TreeBody& body : tree.bodies) {
    const Eigen::Index positions = body.joint.position_count();
    if (positions > body.joint.velocity_count()) state[body.position + positions - 4] = 1;
  }
  dynamics.update(0, state);
  for (std::size_t k = 0; k < tree.bodies.size(); ++k) {
    const BodyState moved = dynamics.body_state(k);
    Body& body = model.bodies[tree.bodies[k].index];
    body.initial_pose = {moved.position_m, Eigen::Quaterniond(moved.rotation)};
    body.initial_velocity_m_s = moved.velocities.head<3>();
    body.initial_angular_velocity_rad_s = moved.velocities.segment<3>(3);
  }
  return model;
}

}  // namespace

int main() {
  count_both("head on neck", head_on_neck());
  count_both("forest", forest());
}
