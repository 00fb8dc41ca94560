// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "multibody/equations/equations.h"
#include "multibody/model/carriers.h"
#include "multibody/model/joint_check.h"
#include "multibody/tree/marker_residual.h"
#include "multibody/tree/tree_dynamics.h"
#include "multibody/tree/tree_error.h"
#include "multibody/tree/tree_rest.h"
#include "multibody/tree/tree_start.h"

namespace flexneck::multibody {
namespace {

using Eigen::Index;

Violation square_root(const Violation& squares) {
  return {std::sqrt(squares.translation), std::sqrt(squares.rotation)};
}

class RecursiveEquations final : public Equations {
 public:
  RecursiveEquations(const Model& model, const SolverOptions& solver, Drive drive)
      : tree_(model),
        dynamics_(tree_, drive),
        error_(tree_, solver.relative_tolerance, solver.absolute_tolerance),
        guard_(model, {solver.relative_tolerance, solver.absolute_tolerance}, tree_.size_m),
        markers_(model.markers.size()),
        angles_rad_(model.joints.size(), 0) {}

  Vector given_state() override {
    const RunStart& start = tree_.model.start;
    Vector state = relaxed(tree::given_state(tree_), start.time_s);
    if (start.internal.size() > 0) tree_.internal(state) = start.internal;
    state.tail<2>() << start.dissipated_J, start.work_J;
    return state;
  }

  Vector given_place() override { return tree::given_positions(tree_); }

  Vector equilibrium_state() override {
    const auto carriers = carrier_velocities(tree_.model);
    bool any_floats = false;
    for (const tree::TreeBody& body : tree_.bodies) {
      const bool floats = body.joint_index == tree::kNone;
      if (floats && !carriers[body.index]) refuse_floating_body(body.name);
      any_floats = any_floats || floats;
    }
    tree::TreeDynamics held(tree_, Drive::held);
    tree::TreeRest rest(held, tree::given_positions(tree_));
    find_equilibrium(rest);
    // Rates relative to the prescribed bodies are zero: all bodies move with them. Those of bodies
    // without a joint are relative to the world.
    return relaxed(any_floats ? carried(held, rest.state(), carriers) : rest.state());
  }

  void settle(double time_s, Vector& state, RunWatch& watch) override {
    dynamics_.relax();
    tree::TreeRest rest(dynamics_, state, time_s);
    find_equilibrium(rest, [&] {
      if (watch.markers().empty()) return;
      show(time_s, rest.state(), watch);
      watch.look(time_s);
      dynamics_.relax();
    });
    state = relaxed(rest.state(), time_s);
    count_turns(state);
  }

  void set_interval(double begin_s, double end_s) override {
    dynamics_.set_interval(begin_s, end_s);
  }
  void derivative(double time_s, const Vector& state, Vector& rate) override {
    dynamics_.evaluate(time_s, state, rate);
  }
  void finish_step(double time_s, Vector& state, Vector& rate) override {
    normalise(state);
    dynamics_.evaluate(time_s, state, rate);
  }
  ErrorEstimate measure(const Vector& begin, const Vector& end,
                        const Vector& error) const override {
    return error_(begin, end, error);
  }
  std::string name_of(std::size_t component) const override { return error_.name_of(component); }
  const ForceSet& forces() const override { return dynamics_.forces(); }
  int evaluations() const override { return dynamics_.evaluations(); }

  Layout layout() const override {
    return {tree_.position_count, tree_.velocity_count, tree_.internal_count, 0};
  }
  void retract(Eigen::Ref<Vector> positions,
               const Eigen::Ref<const Vector>& change) const override {
    tree::retract(tree_, change, positions);
  }
  const Vector& multipliers() const override { return no_multipliers_; }
  void begin_step(const Vector& state, const Vector& rate, double length_s) override {
    dynamics_.begin_step(state, rate, length_s);
  }
  /// Residual in the form V' - F(Q, V), whose mass matrix is the identity.
  void residual(double time_s, const Vector& state, const Vector& accelerations,
                const Vector& /*multipliers*/, Vector& residual) override {
    dynamics_.follow_step();
    dynamics_.update(time_s, state);
    dynamics_.solve();
    residual = accelerations - dynamics_.accelerations();
  }
  void inertia(Eigen::SparseMatrix<double>& mass,
               Eigen::SparseMatrix<double>& /*rows_transposed*/) const override {
    for (Index k = 0; k < mass.cols(); ++k) mass.coeffRef(k, k) = 1;
  }
  void rate(const Vector& state, const Vector& accelerations, Vector& rate) const override {
    dynamics_.fill_rate(state, accelerations, rate);
  }

  /// Checks deformations; joint coordinates satisfy the joints and count turns.
  void accept(double time_s, const Vector& state, RunWatch& watch) override {
    count_turns(state);
    for (const tree::TreeBody& body : tree_.bodies)
      watch.check_deformation(
          time_s, body.index,
          state.segment(body.position + body.joint.position_count(), body.inertia.mode_count()));
  }
  double joint_angle_rad(std::size_t joint) const override { return angles_rad_[joint]; }
  void show(double time_s, const Vector& state, RunWatch& watch) override {
    dynamics_.give_internal(state);
    dynamics_.update(time_s, state);
    for (std::size_t k = 0; k < watch.markers().size(); ++k) {
      MarkerState& motion = markers_[watch.markers()[k]];
      dynamics_.marker_state(watch.markers()[k], motion);
      watch.show(k, motion.rotation, motion.angular_velocity_rad_s);
    }
  }
  Energies energies(const Vector& /*state*/) const override { return dynamics_.energies(); }

  void record(double time_s, Vector& state, Recorder& recorder, Index column) override {
    normalise(state);
    dynamics_.give_internal(state);
    dynamics_.update(time_s, state);
    dynamics_.solve();
    for (std::size_t k = 0; k < tree_.markers.size(); ++k) {
      dynamics_.marker_state(k, markers_[k]);
      recorder.marker(column, k, markers_[k]);
    }
    check_joints(time_s);
    for (std::size_t k = 0; k < tree_.body_of_joint.size(); ++k)
      recorder.joint(column, k, dynamics_.joint_reaction(k), dynamics_.joint_axes(k));
    for (std::size_t b = 0; b < tree_.bodies.size(); ++b)
      recorder.modal(column, tree_.bodies[b].index, dynamics_.modal(b));
    if (recorder.keeps_states()) {
      for (std::size_t b = 0; b < tree_.bodies.size(); ++b)
        recorder.state(column, tree_.bodies[b].index, dynamics_.body_state(b));
      recorder.internal(column, tree_.internal(state));
      for (std::size_t k = 0; k < tree_.body_of_joint.size(); ++k)
        if (tree_.model.joints[k].kind->has_angle)
          recorder.joint_angle(column, k, tree::joint_angle_rad(tree_, k, state));
    }
    recorder.energy(column, dynamics_.energies(), state[state.size() - 2], state[state.size() - 1]);
  }

 private:
  /// A state at rest with all bodies at the velocity of their carriers.
  Vector carried(tree::TreeDynamics& held, const Vector& state,
                 const std::vector<std::optional<Eigen::Vector3d>>& velocities) const {
    held.update(0, state);
    std::vector<BodyState> bodies;
    for (std::size_t b = 0; b < tree_.bodies.size(); ++b) {
      bodies.push_back(held.body_state(b));
      const auto& velocity = velocities[tree_.bodies[b].index];
      bodies.back().velocities.setZero();
      if (velocity) bodies.back().velocities.head<3>() = *velocity;
    }
    Vector result = tree::state_of(tree_, bodies);
    result.head(tree_.position_count) = state.head(tree_.position_count);
    return result;
  }

  void count_turns(const Vector& state) {
    for (std::size_t k = 0; k < angles_rad_.size(); ++k)
      if (tree_.model.joints[k].kind->has_angle)
        angles_rad_[k] = tree::joint_angle_rad(tree_, k, state);
  }

  /// The state with the internal variables of force elements after a long time at rest.
  Vector relaxed(Vector state, double time_s = 0) {
    if (tree_.internal_count == 0) return state;
    dynamics_.relax();
    dynamics_.update(time_s, state);
    tree_.internal(state) = dynamics_.forces().internal();
    return state;
  }

  void check_joints(double time_s) {
    const std::vector<Joint>& joints = tree_.model.joints;
    for (std::size_t k = 0; k < joints.size(); ++k) {
      const MarkerState& i = markers_[joints[k].marker_i];
      const MarkerState& j = markers_[joints[k].marker_j];
      const tree::SquaredResidual found(joints[k], i, j);
      if (guard_.is_nothing(found.position, found.velocity)) continue;
      for (const MarkerState* each : {&i, &j})
        guard_.see(each->position_m, each->velocity_m_s, each->angular_velocity_rad_s);
      guard_.check(time_s, k, square_root(found.position), square_root(found.velocity), false);
    }
  }

  void normalise(Vector& state) const {
    for (const tree::TreeBody& body : tree_.bodies) {
      const Index nq = body.joint.position_count();
      if (nq > body.joint.velocity_count()) state.segment<4>(body.position + nq - 4).normalize();
    }
  }

  tree::Tree tree_;
  tree::TreeDynamics dynamics_;
  tree::TreeError error_;
  JointGuard guard_;
  std::vector<MarkerState> markers_;  ///< by the model's markers, at the last output
  std::vector<double> angles_rad_;    ///< angles of the joints that have one, as last counted
  Vector no_multipliers_;
};

}  // namespace

std::unique_ptr<Equations> recursive_equations(const Model& model, const SolverOptions& solver,
                                               Drive drive) {
  return std::make_unique<RecursiveEquations>(model, solver, drive);
}

}  // namespace flexneck::multibody
