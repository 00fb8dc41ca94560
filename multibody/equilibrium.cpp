// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/equilibrium.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/Eigenvalues>

#include "geometry/foundation/error.h"
#include "multibody/initial_state.h"
#include "multibody/reduced_dynamics.h"

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kMostIterations = 200;
/// Extent (see ReducedDynamics) of the largest step, and of the one that ends the search: Newton's
/// convergence is quadratic, so what is left behind the last is rounding.
constexpr double kLargestStep = 0.5;
constexpr double kConverged = 1e-10;
/// Stiffness below this share of the largest is none: the direction is neutral.
constexpr double kNeutral = 1e-10;

/// Of gravity, strain and the forces at time zero, for equations as solved.
double potential_energy(const EquationsOfMotion& equations) {
  const System& system = equations.system();
  double energy = 0;
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const BodyConstants& constants = system.bodies[b].constants;
    energy += gravitational_energy_J(constants, system.gravity_m_s2, equations.body(b)) +
              strain_energy_J(constants, equations.body(b));
  }
  for (std::size_t k = 0; k < system.forces.size(); ++k) {
    const PointForce& force = system.forces[k];
    energy -= equations.force_N(k) * force.direction.dot(equations.marker(force.marker).p);
  }
  return energy;
}

/// Newton's step with the stiffness made positive, so that it always leads downhill.
VectorXd descent_step(const MatrixXd& stiffness, const VectorXd& force) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen((stiffness + stiffness.transpose()) / 2);
  const VectorXd magnitude = eigen.eigenvalues().cwiseAbs();
  // Not zero even where all stiffness vanishes: the caller shortens a long step.
  const double floor = std::max(kNeutral * magnitude.maxCoeff(), 1e-9);
  VectorXd along = eigen.eigenvectors().transpose() * force;
  // In a neutral direction only a force that is more than rounding counts.
  const double noise = 1e-12 * force.norm();
  for (Index i = 0; i < along.size(); ++i) {
    const bool neutral = magnitude[i] <= floor;
    along[i] =
        neutral && std::abs(along[i]) <= noise ? 0 : along[i] / std::max(magnitude[i], floor);
  }
  return eigen.eigenvectors() * along;
}

/// Velocity of the driven body that each free body hangs on, through joints; none if there is none.
class Carriers {
 public:
  Carriers(const Model& model, const System& system)
      : system_(system), velocities_(system.bodies.size()) {
    // As many passes as the longest chain of joints is long.
    for (std::size_t pass = 0; pass <= system.bodies.size(); ++pass)
      for (std::size_t k = 0; k < model.joints.size(); ++k) {
        if (model.joints[k].kind == JointKind::free) continue;
        carry(k, model.joints[k].marker_i, model.joints[k].marker_j);
        carry(k, model.joints[k].marker_j, model.joints[k].marker_i);
      }
  }

  const std::optional<Vector3d>& velocity(std::size_t body) const { return velocities_[body]; }

 private:
  void carry(std::size_t joint, std::size_t from, std::size_t to) {
    const SystemMarker& source = system_.markers[from];
    const std::size_t target = system_.markers[to].free_body;
    if (target == JointPlace::kNoBody) return;
    const std::optional<Vector3d> velocity =
        source.free_body == JointPlace::kNoBody
            ? std::optional<Vector3d>(system_.driven[source.driven_body].velocity_m_s(0))
            : velocities_[source.free_body];
    if (!velocity) return;
    if (velocities_[target] && (*velocities_[target] - *velocity).norm() > 0)
      throw InputError("joint '" + system_.joints[joint].name + "': body '" +
                       system_.bodies[target].name +
                       "' hangs on driven bodies of different initial velocity; a start from "
                       "equilibrium needs one velocity");
    velocities_[target] = velocity;
  }

  const System& system_;
  std::vector<std::optional<Vector3d>> velocities_;
};

}  // namespace

VectorXd carried_velocities(const Model& model, const System& system) {
  const Carriers carriers(model, system);
  VectorXd velocities = VectorXd::Zero(system.velocity_count);
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    if (!carriers.velocity(b))
      throw InputError("body '" + system.bodies[b].name +
                       "': no joint connects it, directly or through others, to a driven body, so "
                       "it has no equilibrium");
    velocities.segment<3>(system.bodies[b].velocity) = *carriers.velocity(b);
  }
  return velocities;
}

VectorXd equilibrium_positions(const Model& model, EquationsOfMotion& equations) {
  const System& system = equations.system();
  carried_velocities(model, system);
  VectorXd state = given_state(model, system);
  join(model, equations, state, Check::positions);
  VectorXd positions = state.head(system.position_count);
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    ReducedDynamics reduced(equations, positions);
    if (reduced.count() == 0) return positions;
    const VectorXd rest = VectorXd::Zero(reduced.count());
    const VectorXd force = reduced.accelerations_at(rest);
    const double energy = potential_energy(equations);
    if (!(force.allFinite() && std::isfinite(energy))) break;
    VectorXd step = descent_step(reduced.stiffness(), force);
    step *= std::min(1.0, kLargestStep / std::max(reduced.extent(step), kConverged));
    if (reduced.extent(step) <= kConverged) return reduced.positions_at(step);
    // Halve the step until it leads down; close to the end the energy no longer tells, the forces
    // do.
    for (int halving = 0; halving < 40; ++halving, step /= 2) {
      const double remaining = reduced.accelerations_at(step).norm();
      if (potential_energy(equations) < energy || remaining < force.norm()) break;
    }
    positions = reduced.positions_at(step);
  }
  throw ComputationError("no static equilibrium was found from the poses given, after " +
                         std::to_string(kMostIterations) + " steps");
}

}  // namespace flexneck::multibody
