// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/descriptor/state_error.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "multibody/equations/internal_error.h"

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr std::size_t kComponents = 6;
constexpr std::array<const char*, kComponents> kNames = {
    "position", "rotation", "deformation", "velocity", "angular velocity", "rate of deformation"};

}  // namespace

StateError::StateError(const System& system, double relative, double absolute)
    : system_(system), tolerance_{relative, absolute} {}

/// Speed of the body that rotates or deforms fastest, m/s.
double StateError::fastest(const VectorXd& state) const {
  double speed = 0;
  for (const FreeBody& body : system_.bodies) {
    const Index m = body.constants.mode_count();
    const Index v = system_.position_count + body.velocity;
    speed = std::max({speed, system_.size_m * state.segment<3>(v + 3).norm(),
                      state.segment(v + 6, m).norm() / std::sqrt(body.constants.mass)});
  }
  return speed;
}

ErrorEstimate StateError::operator()(const VectorXd& begin, const VectorXd& end,
                                     const VectorXd& error) const {
  ErrorEstimate worst;
  const auto consider = [&](std::size_t component, double size, double reference) {
    worst.consider(component, tolerance_.ratio(size, reference));
  };
  const double speed = std::max(fastest(begin), fastest(end));
  for (std::size_t b = 0; b < system_.bodies.size(); ++b) {
    const FreeBody& body = system_.bodies[b];
    const Index m = body.constants.mode_count();
    const Index q = body.position;
    const Index v = system_.position_count + body.velocity;
    const std::size_t first = b * kComponents;
    consider(first, error.segment<3>(q).norm(), system_.size_m);
    // A quaternion changes by half the angle.
    consider(first + 1, 2 * error.segment<4>(q + 3).norm(), 1);
    consider(first + 3, error.segment<3>(v).norm(),
             std::max({begin.segment<3>(v).norm(), end.segment<3>(v).norm(), speed}));
    consider(first + 4, system_.size_m * error.segment<3>(v + 3).norm(), speed);
    if (m == 0) continue;
    const double root_mass = std::sqrt(body.constants.mass);
    const ModalAmplitude present(body.constants.springs.stiffness, end.segment(q + 7, m),
                                 end.segment(v + 6, m));
    consider(first + 2, error.segment(q + 7, m).norm() / root_mass,
             present.displacement / root_mass);
    consider(first + 5, error.segment(v + 6, m).norm() / root_mass, present.velocity / root_mass);
  }
  consider_internal(system_.internal(error), system_.internal_blocks, system_.size_m, tolerance_,
                    system_.bodies.size() * kComponents, worst);
  return worst;
}

std::string StateError::name_of(std::size_t component) const {
  if (system_.bodies.empty()) return "work (no body is free)";
  const std::size_t of_bodies = system_.bodies.size() * kComponents;
  if (component >= of_bodies) return name_of_branch(system_.model.forces, component - of_bodies);
  const std::string& body = system_.bodies[component / kComponents].name;
  return std::string(kNames[component % kComponents]) + " of body '" + body + "'";
}

}  // namespace flexneck::multibody
