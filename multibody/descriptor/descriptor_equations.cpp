// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <set>
#include <vector>

#include "multibody/descriptor/equations_of_motion.h"
#include "multibody/descriptor/equilibrium.h"
#include "multibody/descriptor/initial_state.h"
#include "multibody/descriptor/mobility.h"
#include "multibody/descriptor/projection.h"
#include "multibody/descriptor/reduced_dynamics.h"
#include "multibody/descriptor/state_error.h"
#include "multibody/descriptor/system.h"
#include "multibody/equations/equations.h"

namespace flexneck::multibody {

namespace {

/// The velocity block of each free body, with the blocks of all bodies that joints or force
/// elements couple with it.
std::vector<Equations::VelocityBlock> coupled_bodies(const System& system, const ForceSet& forces) {
  std::vector<std::vector<std::size_t>> ties = forces.markers_of_elements();
  for (const Joint& joint : system.joints) ties.push_back({joint.marker_i, joint.marker_j});
  std::vector<std::set<std::size_t>> coupled(system.bodies.size());
  for (std::size_t b = 0; b < coupled.size(); ++b) coupled[b].insert(b);
  for (const std::vector<std::size_t>& markers : ties)
    for (const std::size_t one : markers)
      for (const std::size_t other : markers) {
        const std::size_t body = system.markers[one].free_body;
        const std::size_t tied = system.markers[other].free_body;
        if (body != JointPlace::kNoBody && tied != JointPlace::kNoBody) coupled[body].insert(tied);
      }
  std::vector<Equations::VelocityBlock> blocks;
  for (std::size_t b = 0; b < coupled.size(); ++b)
    blocks.push_back({system.bodies[b].velocity,
                      system.bodies[b].constants.velocity_count(),
                      {coupled[b].begin(), coupled[b].end()}});
  return blocks;
}

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Motion of a marker: pdd = P Vdot + gp, Omd = W Vdot + gr.
MarkerState marker_state(const EquationsOfMotion& equations, std::size_t index) {
  const System& system = equations.system();
  const NodeKinematics& motion = equations.marker(index);
  MarkerState state{motion.p, motion.pd, motion.gp, motion.R, motion.Om, motion.gr};
  const std::size_t b = system.markers[index].free_body;
  if (b == JointPlace::kNoBody) return state;
  const auto rates = equations.accelerations().segment(system.bodies[b].velocity, motion.P.cols());
  state.acceleration_m_s2 += motion.P * rates;
  state.angular_acceleration_rad_s2 += motion.W * rates;
  return state;
}

Energies energies_of(const EquationsOfMotion& equations, const VectorXd& state) {
  const System& system = equations.system();
  Energies sum;
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const FreeBody& body = system.bodies[b];
    const BodyTerms& terms = equations.body(b);
    const auto V =
        state.segment(system.position_count + body.velocity, body.constants.velocity_count());
    sum.kinetic_J += kinetic_energy_J(terms, V);
    sum.gravitational_J += gravitational_energy_J(body.constants, system.gravity_m_s2, terms);
    sum.strain_J += body.constants.springs.energy_J(terms.a);
  }
  sum.strain_J += equations.forces().stored_J();
  for (const PrescribedMotion& base : equations.prescribed()) {
    double carried_J = 0;
    for (std::size_t b = 0; b < system.bodies.size(); ++b) {
      const BodyConstants& body = system.bodies[b].constants;
      const Vector3d& w = base.angular_velocity_rad_s;
      const Vector3d v = base.velocity_m_s + w.cross(equations.body(b).x - base.position_m);
      carried_J += carried_energy_J(v, w, body.mass, body.J0.trace());
    }
    sum.carried_J = std::max(sum.carried_J, carried_J);
  }
  return sum;
}

class DescriptorEquations final : public Equations {
 public:
  DescriptorEquations(const Model& model, const SolverOptions& solver, Drive drive)
      : model_(model),
        system_(model),
        equations_(system_, drive),
        projection_(equations_),
        error_(system_, solver.relative_tolerance, solver.absolute_tolerance),
        guard_(model, {solver.relative_tolerance, solver.absolute_tolerance}, system_.size_m) {}

  Vector given_state() override {
    Vector state = multibody::given_state(model_, system_);
    join(model_, equations_, state, Check::positions_and_velocities);
    const RunStart& start = model_.start;
    system_.internal(state) =
        start.internal.size() > 0 ? start.internal : equations_.forces().internal();
    state.tail<2>() << start.dissipated_J, start.work_J;
    return state;
  }

  Vector given_place() override {
    Vector state = multibody::given_state(model_, system_);
    join(model_, equations_, state, Check::positions);
    state.segment(system_.position_count, system_.velocity_count).setZero();
    return state;
  }

  Vector equilibrium_state() override {
    EquationsOfMotion held(system_, Drive::held);
    Vector state = Vector::Zero(system_.state_count());
    state.head(system_.position_count) = equilibrium_positions(model_, held);
    state.segment(system_.position_count, system_.velocity_count) =
        carried_velocities(model_, system_);
    equations_.take_turns(held);
    projection_.apply(0, state);
    system_.internal(state) = equations_.forces().internal();
    return state;
  }

  void settle(double time_s, Vector& state, RunWatch& watch) override {
    equations_.relax();
    Vector positions = state.head(system_.position_count);
    // The prescribed bodies may have moved since.
    projection_.converge_positions(time_s, positions);
    state.head(system_.position_count) =
        settled_positions(equations_, positions, time_s, [&](const Vector& there) {
          if (watch.markers().empty()) return;
          state.head(system_.position_count) = there;
          show(time_s, state, watch);
          watch.look(time_s);
        });
    if (system_.internal_count == 0) return;
    equations_.relax();
    equations_.set_positions(time_s, state.head(system_.position_count));
    equations_.set_velocities(state.segment(system_.position_count, system_.velocity_count));
    system_.internal(state) = equations_.forces().internal();
  }

  void set_interval(double begin_s, double end_s) override {
    equations_.set_interval(begin_s, end_s);
  }
  void derivative(double time_s, const Vector& state, Vector& rate) override {
    equations_.evaluate(time_s, state, rate);
  }
  void finish_step(double time_s, Vector& state, Vector& rate) override {
    equations_.give_internal(state);
    projection_.apply_behind_step(time_s, state);
    equations_.evaluate_updated(state, rate);
  }
  ErrorEstimate measure(const Vector& begin, const Vector& end,
                        const Vector& error) const override {
    return error_(begin, end, error);
  }
  std::string name_of(std::size_t component) const override {
    const std::optional<std::size_t> indefinite = equations_.solver().indefinite_body();
    if (!indefinite) return error_.name_of(component);
    return error_.name_of(component) + " (the mass matrix of body '" +
           system_.bodies[*indefinite].name +
           "' is not positive definite in its deformed state: its second-order displacements "
           "exceed its thickness; use the recursive formulation, or several bodies instead of this "
           "one)";
  }
  const ForceSet& forces() const override { return equations_.forces(); }
  int evaluations() const override { return equations_.evaluations(); }
  std::vector<std::string> redundant_constraints() const override {
    std::vector<std::string> names;
    for (const KktSolver::RedundantRow& each : equations_.solver().redundant_rows()) {
      const JointRows& joint = equations_.joint(each.joint);
      names.push_back("joint '" + system_.joints[each.joint].name + "', " +
                      name_of_row(joint, each.row));
    }
    return names;
  }

  int freedoms() const override {
    return static_cast<int>(system_.velocity_count - system_.constraint_count) +
           static_cast<int>(equations_.solver().redundant_rows().size());
  }
  std::vector<std::string> doubts() const override { return doubts_of_mobility(equations_); }

  Layout layout() const override {
    return {system_.position_count, system_.velocity_count, system_.internal_count,
            system_.constraint_count};
  }
  std::vector<VelocityBlock> blocks() const override {
    return coupled_bodies(system_, equations_.forces());
  }
  void retract(Eigen::Ref<Vector> positions,
               const Eigen::Ref<const Vector>& change) const override {
    system_.retract(positions, change);
  }
  const Vector& multipliers() const override { return equations_.multipliers(); }
  void begin_step(const Vector& state, const Vector& rate, double length_s) override {
    equations_.begin_step(state, rate, length_s);
  }
  void residual(double time_s, const Vector& state, const Vector& accelerations,
                const Vector& multipliers, Vector& residual) override {
    equations_.residual(time_s, state, accelerations, multipliers, residual);
  }
  void inertia(Eigen::SparseMatrix<double>& mass,
               Eigen::SparseMatrix<double>& rows_transposed) const override {
    assemble_mass(equations_, mass);
    assemble_rows_transposed(equations_, rows_transposed);
  }
  void rate(const Vector& state, const Vector& accelerations, Vector& rate) const override {
    equations_.fill_rate(state, accelerations, rate);
  }
  void redundant_rows(std::vector<Index>& rows) const override {
    rows.clear();
    const KktSolver& solver = equations_.solver();
    for (std::size_t k = 0; k < system_.joints.size(); ++k)
      for (Index row = 0; row < equations_.joint(k).rows; ++row)
        if (solver.is_left_out(k, row)) rows.push_back(solver.joint_offset(k) + row);
  }
  std::vector<Index> motor_rows() const override {
    std::vector<Index> rows;
    for (std::size_t k = 0; k < system_.joints.size(); ++k)
      for (Index row = 0; row < equations_.joint(k).rows; ++row)
        if (is_motor(equations_.joint(k), row))
          rows.push_back(equations_.solver().joint_offset(k) + row);
    return rows;
  }
  void given_velocities(std::vector<bool>& given) override { equations_.given_velocities(given); }

  /// Checks a step. An implicit step's velocities need not satisfy the joints: only an explicit
  /// step projects them.
  void accept(double time_s, const Vector& state, RunWatch& watch) override {
    update(time_s, state);
    equations_.count_turns();
    check_joints(time_s, [](const Violation&, Violation& velocity) { velocity = {}; });
    for (const FreeBody& body : system_.bodies)
      watch.check_deformation(time_s, body.index,
                              state.segment(body.position + 7, body.constants.mode_count()));
  }
  double joint_angle_rad(std::size_t joint) const override {
    return equations_.forces().angle(joint).angle_rad;
  }
  void show(double time_s, const Vector& state, RunWatch& watch) override {
    update(time_s, state);
    equations_.update_idle_markers(state.segment(system_.position_count, system_.velocity_count));
    for (std::size_t k = 0; k < watch.markers().size(); ++k) {
      const NodeKinematics& motion = equations_.marker(watch.markers()[k]);
      watch.show(k, motion.R, motion.Om);
    }
  }

  Energies energies(const Vector& state) const override { return energies_of(equations_, state); }

  void record(double time_s, Vector& state, Recorder& recorder, Index column) override {
    // The correction is of the size of the interpolation's error: with the factors of the
    // uncorrected state, velocities and accelerations are as accurate as the interpolated state.
    equations_.give_internal(state);
    projection_.apply(time_s, state, false);
    equations_.solve();
    equations_.update_idle_markers(state.segment(system_.position_count, system_.velocity_count));
    check_joints(time_s, [&](const Violation& position, const Violation& velocity) {
      recorder.residuals(column, position, velocity);
    });
    for (std::size_t k = 0; k < system_.markers.size(); ++k)
      recorder.marker(column, k, marker_state(equations_, k));
    for (std::size_t k = 0; k < system_.joints.size(); ++k)
      recorder.joint(column, k, equations_.joint_reaction(k),
                     equations_.marker(system_.joints[k].marker_i).R);
    for (std::size_t b = 0; b < system_.bodies.size(); ++b)
      recorder.modal(column, system_.bodies[b].index, equations_.body(b).a);
    if (recorder.keeps_states()) record_state(state, recorder, column);
    if (!equations_.solver().redundant_rows().empty()) record_undetermined(recorder);
    recorder.energy(column, energies_of(equations_, state), state[state.size() - 2],
                    state[state.size() - 1]);
  }

 private:
  void record_state(const Vector& state, Recorder& recorder, Index column) const {
    for (const FreeBody& body : system_.bodies) {
      const Index m = body.constants.mode_count();
      const auto q = state.segment<4>(body.position + 3);
      BodyState motion{state.segment<3>(body.position),
                       Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix(),
                       state.segment(body.position + 7, m),
                       state.segment(system_.position_count + body.velocity, 6 + m),
                       {}};
      recorder.state(column, body.index, motion);
    }
    recorder.internal(column, system_.internal(state));
    for (std::size_t k = 0; k < system_.joints.size(); ++k)
      if (system_.joints[k].kind->has_angle)
        recorder.joint_angle(column, k, equations_.joint_angle(k).angle_rad);
  }

  /// Updates the motion of the bodies and of the markers of joints and forces. Nothing is
  /// factorised.
  void update(double time_s, const Vector& state) {
    equations_.update_positions(time_s, state.head(system_.position_count));
    equations_.update_velocity_residual(
        state.segment(system_.position_count, system_.velocity_count));
  }

  /// Checks the joints in the present configuration.
  /// @param visit  called first with the residuals of each joint
  template <class Visit>
  void check_joints(double time_s, const Visit& visit) {
    for (const Joint& joint : system_.joints)
      for (const std::size_t marker : {joint.marker_i, joint.marker_j}) {
        const NodeKinematics& motion = equations_.marker(marker);
        guard_.see(motion.p, motion.pd, motion.Om);
      }
    const bool left_out = !equations_.solver().redundant_rows().empty();
    for (std::size_t k = 0; k < system_.joints.size(); ++k) {
      const JointRows& joint = equations_.joint(k);
      const Violation position = violation(joint, joint.position_residual);
      Violation velocity = violation(joint, joint.velocity_residual);
      visit(position, velocity);
      guard_.check(time_s, k, position, velocity, left_out,
                   [&] { return contradictory_motors(equations_); });
    }
  }

  /// Records which components of reactions are undetermined: those in which some multipliers
  /// without effect on the motion, B^T lambda = 0, take part.
  void record_undetermined(Recorder& recorder) const {
    const KktSolver& solver = equations_.solver();
    const Eigen::MatrixXd free = free_multipliers(equations_);
    for (std::size_t k = 0; k < system_.joints.size(); ++k) {
      const JointRows& joint = equations_.joint(k);
      const Eigen::Matrix3d& R_i = equations_.marker(system_.joints[k].marker_i).R;
      Eigen::Array<bool, 6, 1> open = Eigen::Array<bool, 6, 1>::Constant(false);
      for (Index c = 0; c < free.cols(); ++c) {
        RowVector multipliers = RowVector::Zero();
        multipliers.head(joint.rows) = free.col(c).segment(solver.joint_offset(k), joint.rows);
        const Reaction found = reaction(joint, multipliers);
        Eigen::Matrix<double, 6, 1> components;
        components << R_i.transpose() * found.force_N, R_i.transpose() * found.moment_Nm;
        open = open || components.array().abs() > 1e-7 * free.col(c).norm();
      }
      recorder.undetermined(k, open);
    }
  }

  const Model& model_;
  System system_;
  EquationsOfMotion equations_;
  Projection projection_;
  StateError error_;
  JointGuard guard_;
};

}  // namespace

std::unique_ptr<Equations> descriptor_equations(const Model& model, const SolverOptions& solver,
                                                Drive drive) {
  return std::make_unique<DescriptorEquations>(model, solver, drive);
}

}  // namespace flexneck::multibody
