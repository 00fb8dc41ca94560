// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/descriptor/equilibrium.h"

#include <optional>
#include <utility>
#include <vector>

#include "geometry/foundation/error.h"
#include "multibody/descriptor/initial_state.h"
#include "multibody/descriptor/reduced_dynamics.h"
#include "multibody/model/joint_check.h"
#include "multibody/numerics/rest.h"

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Of gravity, strain and the forces at time zero, for equations as solved.
double potential_energy(const EquationsOfMotion& equations) {
  const System& system = equations.system();
  double energy = 0;
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const BodyConstants& constants = system.bodies[b].constants;
    energy += gravitational_energy_J(constants, system.gravity_m_s2, equations.body(b)) +
              constants.springs.energy_J(equations.body(b).a);
  }
  return energy + equations.forces().potential_J();
}

/// The descriptor form's coordinates of the search.
class DescriptorRest final : public RestProblem {
 public:
  DescriptorRest(EquationsOfMotion& equations, VectorXd positions, double time_s)
      : equations_(equations), positions_(std::move(positions)), time_s_(time_s) {
    reduced_.emplace(equations_, positions_, time_s_);
  }

  Index count() const override { return reduced_->count(); }
  double extent(const VectorXd& xi) const override { return reduced_->extent(xi); }
  VectorXd forces_at(const VectorXd& xi) override { return reduced_->accelerations_at(xi); }
  double energy() const override { return potential_energy(equations_); }
  MatrixXd stiffness() override { return reduced_->stiffness(); }
  void move_to(const VectorXd& xi) override {
    positions_ = reduced_->positions_at(xi);
    reduced_.emplace(equations_, positions_, time_s_);
  }
  const VectorXd& positions() const { return positions_; }

 private:
  EquationsOfMotion& equations_;
  VectorXd positions_;
  double time_s_;
  std::optional<ReducedDynamics> reduced_;
};

/// Velocity of the prescribed body that each free body hangs on, through joints; none if there is
/// none.
class Carriers {
 public:
  Carriers(const Model& model, const System& system)
      : system_(system), velocities_(system.bodies.size()) {
    // As many passes as the longest chain of joints is long.
    for (std::size_t pass = 0; pass <= system.bodies.size(); ++pass)
      for (std::size_t k = 0; k < model.joints.size(); ++k) {
        if (model.joints[k].kind->holds_nothing()) continue;
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
            ? std::optional<Vector3d>(system_.prescribed[source.prescribed_body].at(0).velocity_m_s)
            : velocities_[source.free_body];
    if (!velocity) return;
    if (velocities_[target] && (*velocities_[target] - *velocity).norm() > 0)
      throw InputError("joint '" + system_.joints[joint].name + "': body '" +
                       system_.bodies[target].name +
                       "' hangs on prescribed bodies of different initial velocity; a start from "
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
    if (!carriers.velocity(b)) refuse_floating_body(system.bodies[b].name);
    velocities.segment<3>(system.bodies[b].velocity) = *carriers.velocity(b);
  }
  return velocities;
}

VectorXd settled_positions(EquationsOfMotion& equations, const VectorXd& positions, double time_s) {
  DescriptorRest rest(equations, positions, time_s);
  find_equilibrium(rest);
  return rest.positions();
}

VectorXd equilibrium_positions(const Model& model, EquationsOfMotion& equations) {
  carried_velocities(model, equations.system());
  return settled_positions(equations, given_positions(model, equations), 0);
}

}  // namespace flexneck::multibody
