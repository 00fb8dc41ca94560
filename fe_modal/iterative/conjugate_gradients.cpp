// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/iterative/conjugate_gradients.h"

#include <string>

#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

/// Of squares of the error in the energy norm. A compliance under the same load is wrong by the
/// square itself, one between two loads by the root, 1e-10, which is asked for to 1e-8.
constexpr double kTolerance = 1e-20;
constexpr int kMostIterations = 2000;

/// Of each column with its partner.
Eigen::VectorXd dots(const Eigen::MatrixXd& one, const Eigen::MatrixXd& other) {
  return one.cwiseProduct(other).colwise().sum().transpose();
}

/// Of two lists, zero where nothing is left to do.
Eigen::VectorXd ratios(const Eigen::VectorXd& above, const Eigen::VectorXd& below) {
  return (below.array() > 0).select(above.cwiseQuotient(below), 0.0);
}

}  // namespace

ConjugateGradientResult conjugate_gradients(const BlockOperator& matrix,
                                            const BlockOperator& preconditioner,
                                            const Eigen::MatrixXd& right_hand_sides) {
  ConjugateGradientResult result{
      Eigen::MatrixXd::Zero(right_hand_sides.rows(), right_hand_sides.cols())};
  Eigen::MatrixXd residuals = right_hand_sides;
  Eigen::MatrixXd directions = preconditioner(residuals);
  Eigen::VectorXd squares = dots(residuals, directions);
  const Eigen::VectorXd aims = kTolerance * squares;
  while ((squares.array() > aims.array()).any()) {
    if (++result.iterations > kMostIterations) {
      throw ComputationError("conjugate gradients have not converged in " +
                             std::to_string(kMostIterations) + " iterations");
    }
    const Eigen::MatrixXd forces = matrix(directions);
    const Eigen::VectorXd steps = ratios(squares, dots(directions, forces));
    result.solutions += directions * steps.asDiagonal();
    residuals -= forces * steps.asDiagonal();
    const Eigen::MatrixXd corrections = preconditioner(residuals);
    const Eigen::VectorXd next = dots(residuals, corrections);
    directions = (corrections + directions * ratios(next, squares).asDiagonal()).eval();
    squares = next;
  }
  return result;
}

}  // namespace flexneck::fe_modal
