// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/inverse_iteration.h"

#include <utility>

#include <Eigen/Eigenvalues>

#include "fe_modal/block_product.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

constexpr int kMostIterations = 50;
/// Directions of the space with a smaller share than this of unit columns are rounding.
constexpr double kDependent = 1e-11;

/// The columns that make the inertia the identity, of the space that columns of unit mass span.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& inertia) {
  const Eigen::VectorXd scale = inertia.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scale.asDiagonal() * inertia *
                                                              scale.asDiagonal());
  const Eigen::VectorXd& shares = solver.eigenvalues();
  const Eigen::Index kept = (shares.array() > kDependent).count();
  return scale.asDiagonal() * solver.eigenvectors().rightCols(kept) *
         shares.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
}

}  // namespace

EigenPairs inverse_iteration(Mat mass, const ShiftInverse& inverse, Eigen::MatrixXd start,
                             const Settled& settled) {
  EigenPairs pairs{Eigen::VectorXd(), std::move(start)};
  Eigen::MatrixXd momenta = block_product(mass, pairs.vectors);
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    pairs.vectors = inverse.solve(momenta);
    // The old momenta are (K - shift M) times the new vectors.
    const Eigen::MatrixXd stiffness = pairs.vectors.transpose() * momenta;
    momenta = block_product(mass, pairs.vectors);
    const Eigen::MatrixXd inertia = pairs.vectors.transpose() * momenta;
    const Eigen::MatrixXd basis = orthonormal(inertia);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(basis.transpose() * stiffness *
                                                                basis);
    const Eigen::MatrixXd turn = basis * solver.eigenvectors();
    const Eigen::VectorXd before = pairs.values;
    pairs.values = solver.eigenvalues().array() + inverse.shift();
    pairs.vectors = (pairs.vectors * turn).eval();
    if (before.size() == pairs.values.size() && settled(before, pairs.values)) return pairs;
    momenta = (momenta * turn).eval();
  }
  throw ComputationError("inverse iteration does not settle");
}

}  // namespace flexneck::fe_modal
