// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/numerics/rest.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/foundation/error.h"
#include "geometry/foundation/symmetric_pairs.h"

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMaxIterations = 200;
/// Extent (see RestProblem) of the largest step, and of the one that ends the search: Newton's
/// convergence is quadratic, so the error after the last step is rounding.
constexpr double kLargestStep = 0.5;
constexpr double kConverged = 1e-10;
/// Fraction of the largest stiffness below which a direction is neutral.
constexpr double kNeutral = 1e-10;

/// Newton's step with the stiffness made positive, so that it always leads downhill.
VectorXd descent_step(const MatrixXd& stiffness, const VectorXd& force) {
  const SymmetricPairs eigen = symmetric_pairs((stiffness + stiffness.transpose()) / 2);
  const VectorXd magnitude = eigen.values.cwiseAbs();
  // The floor is not zero even if all stiffness vanishes: the caller shortens a long step.
  const double floor = std::max(kNeutral * magnitude.maxCoeff(), 1e-9);
  VectorXd along = eigen.vectors.transpose() * force;
  // In a neutral direction only forces above rounding count.
  const double noise = 1e-12 * force.norm();
  for (Index i = 0; i < along.size(); ++i) {
    const bool neutral = magnitude[i] <= floor;
    along[i] =
        neutral && std::abs(along[i]) <= noise ? 0 : along[i] / std::max(magnitude[i], floor);
  }
  return eigen.vectors * along;
}

}  // namespace

void find_equilibrium(RestProblem& rest, const std::function<void()>& moved) {
  if (rest.count() == 0) return;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const VectorXd force = rest.forces_at(VectorXd::Zero(rest.count()));
    const double energy = rest.energy();
    if (!(force.allFinite() && std::isfinite(energy))) break;
    VectorXd step = descent_step(rest.stiffness(), force);
    step *= std::min(1.0, kLargestStep / std::max(rest.extent(step), kConverged));
    if (rest.extent(step) <= kConverged) {
      rest.move_to(step);
      if (moved) moved();
      return;
    }
    // Halve the step until it reduces the energy or, near the end where the energy is only
    // rounding, the forces.
    for (int halving = 0; halving < 40; ++halving, step /= 2) {
      const double remaining = rest.forces_at(step).norm();
      if (rest.energy() < energy || remaining < force.norm()) break;
    }
    rest.move_to(step);
    if (moved) moved();
  }
  throw ComputationError("no static equilibrium was found from the given poses after " +
                         std::to_string(kMaxIterations) + " steps");
}

}  // namespace flexneck::multibody
