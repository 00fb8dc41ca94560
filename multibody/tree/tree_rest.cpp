// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/tree/tree_rest.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace flexneck::multibody::tree {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Extent of the displacements of the finite differences: their error, of second order in it, and
/// rounding are then both about 1e-11 of the result.
constexpr double kDifference = 1e-5;

}  // namespace

TreeRest::TreeRest(TreeDynamics& dynamics, const VectorXd& state, double time_s)
    : dynamics_(dynamics), state_(state), time_s_(time_s) {
  update_basis();
}

void TreeRest::update_basis() {
  // Column i of M^-1 is the change of the accelerations by a unit force in i.
  const Index n = dynamics_.tree().velocity_count;
  if (n == 0) return;
  MatrixXd inverse(n, n);
  const auto accelerations = [&]() -> const VectorXd& {
    dynamics_.update(time_s_, state_);
    dynamics_.solve();
    return dynamics_.accelerations();
  };
  const VectorXd unforced = accelerations();
  for (Index i = 0; i < n; ++i) {
    dynamics_.extra_forces()[i] = 1;
    inverse.col(i) = accelerations() - unforced;
    dynamics_.extra_forces()[i] = 0;
  }
  N_ = Eigen::LLT<MatrixXd>((inverse + inverse.transpose()) / 2).matrixL();
}

double TreeRest::extent(const VectorXd& xi) const {
  const Tree& tree = dynamics_.tree();
  const VectorXd change = N_ * xi;
  double extent = 0;
  for (const TreeBody& body : tree.bodies) {
    const Index nu = body.joint.velocity_count();
    const Index m = body.inertia.mode_count();
    // Distances in m count as if the system's size were one metre: only the order of magnitude
    // matters.
    extent = std::max({extent, change.segment(body.velocity, nu).norm(),
                       change.segment(body.velocity + nu, m).norm() /
                           (std::sqrt(body.inertia.mass) * tree.size_m)});
  }
  return extent;
}

VectorXd TreeRest::state_at(const VectorXd& xi) const {
  VectorXd state = state_;
  retract(dynamics_.tree(), N_ * xi, state.head(dynamics_.tree().position_count));
  return state;
}

VectorXd TreeRest::forces_at(const VectorXd& xi) {
  dynamics_.update(time_s_, state_at(xi));
  dynamics_.solve();
  return N_.triangularView<Eigen::Lower>().solve(dynamics_.accelerations());
}

double TreeRest::energy() const {
  const Energies stored = dynamics_.energies();
  const ForceSet& forces = dynamics_.forces();
  // The energy of springs is in both terms.
  return stored.gravitational_J + stored.strain_J + forces.potential_J() - forces.stored_J();
}

MatrixXd TreeRest::stiffness() {
  MatrixXd result(count(), count());
  for (Index i = 0; i < count(); ++i) {
    VectorXd xi = VectorXd::Unit(count(), i);
    const double step = kDifference / extent(xi);
    xi *= step;
    result.col(i) = (forces_at(-xi) - forces_at(xi)) / (2 * step);
  }
  return result;
}

void TreeRest::move_to(const VectorXd& xi) {
  state_ = state_at(xi);
  update_basis();
}

}  // namespace flexneck::multibody::tree
