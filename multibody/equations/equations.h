// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/SparseCore>

#include "multibody/equations/force_set.h"
#include "multibody/equations/solver_options.h"
#include "multibody/history/recorder.h"
#include "multibody/model/prescribed_path.h"
#include "multibody/numerics/error_estimate.h"

namespace flexneck::multibody {

/// A formulation's equations of motion for one model, as a run sees them. States are its own.
class Equations {
 public:
  using Vector = Eigen::VectorXd;

  virtual ~Equations() = default;

  /// The state that the bodies are given, put onto the joints. @throws InputError as simulate().
  virtual Vector given_state() = 0;
  /// The same at rest: velocities are not looked at.
  virtual Vector given_place() = 0;
  /// Static equilibrium, moving with the prescribed bodies.
  /// @throws InputError, ComputationError as simulate_from_equilibrium().
  virtual Vector equilibrium_state() = 0;

  /// Brings a state at rest to the static equilibrium at a time. Of equations whose prescribed
  /// bodies are held. @throws ComputationError if there is none within reach.
  /// @param watch  looks at each place on the way
  virtual void settle(double time_s, Vector& state, RunWatch& watch) = 0;

  /// Tables are read inside of this interval only, so that at its ends a jump shows its inner side.
  virtual void set_interval(double begin_s, double end_s) = 0;
  virtual void derivative(double time_s, const Vector& state, Vector& rate) = 0;
  /// See InitialValueProblem::finish_step. The last derivative() must have been near.
  virtual void finish_step(double time_s, Vector& state, Vector& rate) = 0;
  virtual ErrorEstimate measure(const Vector& begin, const Vector& end,
                                const Vector& error) const = 0;
  virtual std::string name_of(std::size_t component) const = 0;
  /// Of the last evaluation: pieces() tells where loads have kinks.
  virtual const ForceSet& forces() const = 0;

  /// How many positions (with which a state begins), velocities and internal variables of force
  /// elements (which follow; then come two quadratures), and how many constraints.
  struct Layout {
    Eigen::Index positions, velocities, internal, constraints;
  };
  virtual Layout layout() const = 0;
  /// Velocities that follow each other, of a body as a rule, and the blocks whose equations their
  /// motion enters, itself among them, ascending. In layout()'s order.
  struct VelocityBlock {
    Eigen::Index begin, size;
    std::vector<std::size_t> coupled;
  };
  virtual std::vector<VelocityBlock> blocks() const { return {{0, layout().velocities, {0}}}; }
  /// Positions moved by a displacement of the kind of velocities.
  virtual void retract(Eigen::Ref<Vector> positions,
                       const Eigen::Ref<const Vector>& change) const = 0;
  /// Of the last derivative() or finish_step(), (constraints).
  virtual const Vector& multipliers() const = 0;
  /// Where a step begins, for residual(): internal variables are those at its end, which the
  /// positions there say.
  virtual void begin_step(const Vector& state, const Vector& rate, double length_s) = 0;
  /// What given accelerations and multipliers leave of the equations of motion, (velocities), above
  /// what the positions leave of the constraints.
  virtual void residual(double time_s, const Vector& state, const Vector& accelerations,
                        const Vector& multipliers, Vector& residual) = 0;
  /// Where residual() was last: its derivatives by the accelerations and by the multipliers,
  /// (velocities, constraints). Always sets the same entries.
  virtual void inertia(Eigen::SparseMatrix<double>& mass,
                       Eigen::SparseMatrix<double>& rows_transposed) const = 0;
  /// The rate of a state like the one whose residual() was last.
  virtual void rate(const Vector& state, const Vector& accelerations, Vector& rate) const = 0;
  /// Indices of constraints that others hold already, as of the last derivative().
  virtual void redundant_rows(std::vector<Eigen::Index>& rows) const { rows.clear(); }
  /// Indices of constraints that are motors'.
  virtual std::vector<Eigen::Index> motor_rows() const { return {}; }
  /// Sets which velocities constraints alone decide, as of the last derivative(): those of bodies
  /// that motors, prescribed bodies and joints leave no freedom.
  virtual void given_velocities(std::vector<bool>& /*given*/) {}

  /// Checks behind an accepted step, and at the start of a run, that joints hold and that bodies
  /// deform within reason. Counts the turns of joints on. @throws ComputationError of a guard that
  /// ends the run.
  virtual void accept(double time_s, const Vector& state, RunWatch& watch) = 0;
  /// The angle of a joint that has one, as accept() or settle() counted it last.
  virtual double joint_angle_rad(std::size_t joint) const = 0;
  /// Shows a watch the markers that it follows, of a state inside or at the end of a step.
  virtual void show(double time_s, const Vector& state, RunWatch& watch) = 0;

  /// The energies of a state like the one that was evaluated last.
  virtual Energies energies(const Vector& state) const = 0;

  /// Records an interpolated state, put onto the joints first.
  virtual void record(double time_s, Vector& state, Recorder& recorder, Eigen::Index column) = 0;
  virtual int evaluations() const = 0;
  /// Constraints that others hold already, as of the last evaluation.
  virtual std::vector<std::string> redundant_constraints() const { return {}; }
  /// Independent motions that joints and motors leave, as of the last evaluation.
  virtual int freedoms() const { return static_cast<int>(layout().velocities); }
  /// Sentences: what the joints hold only by little, so that the model's numbers decide how it
  /// moves.
  virtual std::vector<std::string> doubts() const { return {}; }
};

/// The paper's form with multipliers: positions of all bodies, joints as constraints.
std::unique_ptr<Equations> descriptor_equations(const Model& model, const SolverOptions& solver,
                                                Drive drive = Drive::prescribed);
/// Joint coordinates of trees. @throws InputError if a joint closes a loop.
std::unique_ptr<Equations> recursive_equations(const Model& model, const SolverOptions& solver,
                                               Drive drive = Drive::prescribed);

}  // namespace flexneck::multibody
