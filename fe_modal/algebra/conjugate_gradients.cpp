// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/conjugate_gradients.h"

#include <string>
#include <utility>

#include "fe_modal/algebra/matrix_product.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/symmetric_pairs.h"

namespace flexneck::fe_modal {
namespace {

/// Of squares of the error in the energy norm. A compliance under the same load is wrong by the
/// square itself, one between two loads by the root, 1e-10, which is asked for to 1e-8.
constexpr double kTolerance = 1e-20;
/// Of squares of energy: combinations of the directions that have less are rounding. There are some
/// when a column has converged, or two have come to the same.
constexpr double kNoDirection = 1e-12;

/// Combinations of the directions D that have D^T A D = 1, without those that say nothing new.
/// @param energies D^T A D
Eigen::MatrixXd orthonormal_combinations(const Eigen::MatrixXd& energies) {
  const Eigen::VectorXd scale = energies.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const auto [squares, vectors] =
      symmetric_pairs(scale.asDiagonal() * energies * scale.asDiagonal());
  const Eigen::Index kept = (squares.array() > kNoDirection).count();
  return scale.asDiagonal() * vectors.rightCols(kept) *
         squares.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
}

Eigen::MatrixXd product(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& combination) {
  Eigen::MatrixXd result(columns.rows(), combination.cols());
  multiply(1, columns, combination, 0, result);
  return result;
}

}  // namespace

Eigen::MatrixXd conjugate_gradients(const Ranks& ranks, const BlockOperator& matrix,
                                    const BlockOperator& preconditioner,
                                    const Eigen::MatrixXd& right_hand_sides,
                                    const Eigen::VectorXd& known_energies, int max_iterations) {
  Eigen::MatrixXd solutions =
      Eigen::MatrixXd::Zero(right_hand_sides.rows(), right_hand_sides.cols());
  Eigen::MatrixXd residuals = right_hand_sides;
  Eigen::MatrixXd directions = preconditioner(residuals);
  Eigen::VectorXd energies = column_products(ranks, residuals, directions);
  if (known_energies.size() > 0) energies += known_energies;
  bool converged = false;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    Eigen::MatrixXd forces = matrix(directions);
    const Eigen::MatrixXd combinations =
        orthonormal_combinations(inner_products(ranks, directions, forces));
    directions = product(directions, combinations);
    const Eigen::MatrixXd steps = inner_products(ranks, directions, residuals);
    multiply(1, directions, steps, 1, solutions);
    if (converged) return solutions;
    forces = product(forces, combinations);
    multiply(-1, forces, steps, 1, residuals);
    Eigen::MatrixXd next = preconditioner(residuals);
    // The direction is at hand by then: one more step costs no preconditioner.
    converged =
        (column_products(ranks, residuals, next).array() <= kTolerance * energies.array()).all();
    multiply(-1, directions, inner_products(ranks, forces, next), 1, next);
    directions = std::move(next);
  }
  throw ComputationError("conjugate gradients have not converged in " +
                         std::to_string(max_iterations) + " iterations");
}

}  // namespace flexneck::fe_modal
