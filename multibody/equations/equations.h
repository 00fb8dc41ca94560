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

/// A formulation's equations of motion for one model, as a run uses them. Each formulation has its
/// own state vector.
class Equations {
 public:
  using Vector = Eigen::VectorXd;

  virtual ~Equations() = default;

  /// The initial state of the bodies, corrected to satisfy the joints.
  /// @throws InputError as simulate().
  virtual Vector given_state() = 0;
  /// The initial positions at rest: given velocities are ignored.
  virtual Vector given_place() = 0;
  /// State of static equilibrium, moving with the prescribed bodies.
  /// @throws InputError, ComputationError as simulate_from_equilibrium().
  virtual Vector equilibrium_state() = 0;

  /// Brings a state at rest to the static equilibrium at a time. Requires equations with fixed
  /// prescribed bodies.
  /// @throws ComputationError if there is none within reach.
  /// @param watch  sees each intermediate state
  virtual void settle(double time_s, Vector& state, RunWatch& watch) = 0;

  /// Restricts the reading of tables to this interval: a jump at its ends then shows its inner
  /// side.
  virtual void set_interval(double begin_s, double end_s) = 0;
  virtual void derivative(double time_s, const Vector& state, Vector& rate) = 0;
  /// See InitialValueProblem::finish_step. The state of the last derivative() must be close.
  virtual void finish_step(double time_s, Vector& state, Vector& rate) = 0;
  virtual ErrorEstimate measure(const Vector& begin, const Vector& end,
                                const Vector& error) const = 0;
  virtual std::string name_of(std::size_t component) const = 0;
  /// Force elements as in the last evaluation: pieces() shows where loads have kinks.
  virtual const ForceSet& forces() const = 0;

  /// Numbers of positions (with which a state begins), velocities and internal variables of force
  /// elements (which follow; two quadratures come last), and of constraints.
  struct Layout {
    Eigen::Index positions, velocities, internal, constraints;
  };
  virtual Layout layout() const = 0;
  /// A block of consecutive velocities, usually of one body, and the indices of the blocks whose
  /// equations depend on its motion, its own included, ascending. Blocks are in layout()'s order.
  struct VelocityBlock {
    Eigen::Index begin, size;
    std::vector<std::size_t> coupled;
  };
  virtual std::vector<VelocityBlock> blocks() const { return {{0, layout().velocities, {0}}}; }
  /// Moves positions by a displacement with the components of velocities.
  virtual void retract(Eigen::Ref<Vector> positions,
                       const Eigen::Ref<const Vector>& change) const = 0;
  /// Multipliers of the last derivative() or finish_step(), (constraints).
  virtual const Vector& multipliers() const = 0;
  /// Sets the beginning of a step for residual(), which then uses the internal variables at the
  /// step's end, as determined by the positions there.
  virtual void begin_step(const Vector& state, const Vector& rate, double length_s) = 0;
  /// Residual of the equations of motion for given accelerations and multipliers, (velocities),
  /// above the position residual of the constraints.
  virtual void residual(double time_s, const Vector& state, const Vector& accelerations,
                        const Vector& multipliers, Vector& residual) = 0;
  /// Derivatives of the residual by the accelerations and by the multipliers, (velocities,
  /// constraints), at the state of the last residual(). Always sets the same entries.
  virtual void inertia(Eigen::SparseMatrix<double>& mass,
                       Eigen::SparseMatrix<double>& rows_transposed) const = 0;
  /// Computes the rate of the state whose residual() was evaluated last.
  virtual void rate(const Vector& state, const Vector& accelerations, Vector& rate) const = 0;
  /// Returns the indices of redundant constraints in the last derivative().
  virtual void redundant_rows(std::vector<Eigen::Index>& rows) const { rows.clear(); }
  /// Indices of the constraints of motors.
  virtual std::vector<Eigen::Index> motor_rows() const { return {}; }
  /// Marks the velocities that constraints alone determine in the last derivative(): those of
  /// bodies without freedom because of motors, prescribed bodies and joints.
  virtual void given_velocities(std::vector<bool>& /*given*/) {}

  /// Checks after an accepted step, and at the start of a run, that the joints are satisfied and
  /// that deformations are within the limits. Counts the turns of joints.
  /// @throws ComputationError of a guard that ends the run.
  virtual void accept(double time_s, const Vector& state, RunWatch& watch) = 0;
  /// The angle of a joint that has one, as last counted by accept() or settle().
  virtual double joint_angle_rad(std::size_t joint) const = 0;
  /// Passes the motion of the watched markers, in a state inside or at the end of a step, to a
  /// watch.
  virtual void show(double time_s, const Vector& state, RunWatch& watch) = 0;

  /// The energies of the state that was evaluated last.
  virtual Energies energies(const Vector& state) const = 0;

  /// Records an interpolated state after correcting it to satisfy the joints.
  virtual void record(double time_s, Vector& state, Recorder& recorder, Eigen::Index column) = 0;
  virtual int evaluations() const = 0;
  /// Names of redundant constraints in the last evaluation.
  virtual std::vector<std::string> redundant_constraints() const { return {}; }
  /// Number of degrees of freedom that joints and motors leave in the last evaluation.
  virtual int freedoms() const { return static_cast<int>(layout().velocities); }
  /// Warnings on motions that joints constrain only marginally, so that rounding of the model's
  /// numbers decides the motion.
  virtual std::vector<std::string> doubts() const { return {}; }
};

/// The paper's descriptor form with multipliers: positions of all bodies, joints as constraints.
std::unique_ptr<Equations> descriptor_equations(const Model& model, const SolverOptions& solver,
                                                Drive drive = Drive::prescribed);
/// The recursive form in the joint coordinates of trees.
/// @throws InputError if a joint closes a loop.
std::unique_ptr<Equations> recursive_equations(const Model& model, const SolverOptions& solver,
                                               Drive drive = Drive::prescribed);

}  // namespace flexneck::multibody
