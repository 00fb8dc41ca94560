// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/descriptor/equilibrium.h"

#include <optional>
#include <utility>
#include <vector>

#include "multibody/descriptor/initial_state.h"
#include "multibody/descriptor/reduced_dynamics.h"
#include "multibody/model/carriers.h"
#include "multibody/numerics/rest.h"

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Potential energy of gravity, strain and the forces at time zero, for solved equations.
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

/// The equilibrium search in the coordinates of the descriptor form.
class DescriptorRest final : public RestProblem {
 public:
  DescriptorRest(EquationsOfMotion& equations, VectorXd positions, double time_s)
      : equations_(equations), positions_(std::move(positions)), time_s_(time_s) {
    begin();
  }

  Index count() const override { return reduced_->count(); }
  double extent(const VectorXd& xi) const override { return reduced_->extent(xi); }
  VectorXd forces_at(const VectorXd& xi) override { return reduced_->accelerations_at(xi); }
  double energy() const override { return potential_energy(equations_); }
  MatrixXd stiffness() override { return reduced_->stiffness(); }
  void move_to(const VectorXd& xi) override {
    positions_ = reduced_->positions_at(xi);
    begin();
  }
  const VectorXd& positions() const { return positions_; }

 private:
  void begin() {
    reduced_.emplace(equations_, positions_, time_s_);
    equations_.count_turns();
  }

  EquationsOfMotion& equations_;
  VectorXd positions_;
  double time_s_;
  std::optional<ReducedDynamics> reduced_;
};

}  // namespace

VectorXd carried_velocities(const Model& model, const System& system) {
  check_no_body_floats(model);
  const auto carriers = carrier_velocities(model);
  VectorXd velocities = VectorXd::Zero(system.velocity_count);
  for (const FreeBody& body : system.bodies)
    velocities.segment<3>(body.velocity) = *carriers[body.index];
  return velocities;
}

VectorXd settled_positions(EquationsOfMotion& equations, const VectorXd& positions, double time_s,
                           const std::function<void(const VectorXd&)>& moved) {
  DescriptorRest rest(equations, positions, time_s);
  find_equilibrium(rest, [&] {
    if (moved) moved(rest.positions());
  });
  return rest.positions();
}

VectorXd equilibrium_positions(const Model& model, EquationsOfMotion& equations) {
  carried_velocities(model, equations.system());
  return settled_positions(equations, given_positions(model, equations), 0);
}

}  // namespace flexneck::multibody
