// SPDX-License-Identifier: GPL-3.0-or-later
// A rod on a revolute joint, released from the horizontal: flexneck's results and the closed forms.
#include <cmath>
#include <cstdio>
#include <numbers>

#include "multibody/analysis/linearisation.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/simulation/simulation.h"

using namespace flexneck::multibody;

int main() {
  constexpr double kMass = 2;
  constexpr double kHalf = 0.3;  // m, half its length
  constexpr double kGravity = 9.81;
  RigidBody rod;
  rod.mass_kg = kMass;
  rod.center_m = {kHalf, 0, 0};
  const double across = kMass * kHalf * kHalf / 3;
  rod.inertia_kg_m2 = Eigen::Vector3d(1e-6, across, across).asDiagonal();

  Model model;
  model.bodies = {{"ground", PrescribedBody{}, {}}, {"rod", rod, {}}};
  model.markers = {{"pin", 0, "", Eigen::Vector3d::Zero()},
                   {"eye", 1, "", Eigen::Vector3d::Zero()},
                   {"end", 1, "", {2 * kHalf, 0, 0}}};
  model.joints = {{"pin", &kRevoluteJoint, 0, 1, Eigen::Vector3d::UnitY()}};
  model.gravity_m_s2 = {0, 0, -kGravity};

  // By conservation of energy the end passes the lowest point with v^2 = 3 g (2 h).
  SolverOptions solver;
  solver.relative_tolerance = 1e-9;
  const History run = simulate(model, solver, {1.0, 1e-3});
  const double fastest = run.marker("end").velocity_m_s.colwise().norm().maxCoeff();
  const double closed = std::sqrt(6 * kGravity * kHalf);
  std::printf("speed of the end %.6f m/s, by energy %.6f\n", fastest, closed);

  // A rod swings about its end with omega^2 = 3 g / (4 h).
  const double frequency = system_modes(model).front().frequency_Hz;
  const double small = std::sqrt(0.75 * kGravity / kHalf) / (2 * std::numbers::pi);
  std::printf("frequency %.6f Hz, of a rod %.6f\n", frequency, small);
  return std::abs(fastest / closed - 1) < 1e-5 && std::abs(frequency / small - 1) < 1e-6 ? 0 : 1;
}
