// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/iterative/preconditioned_inverse.h"

#include <string>
#include <utility>

#include "fe_modal/algebra/block_product.h"
#include "fe_modal/algebra/conjugate_gradients.h"

namespace flexneck::fe_modal {

Eigen::MatrixXd shifted_product(Mat stiffness, Mat mass, double shift,
                                const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd forces = block_product(stiffness, columns);
  if (shift != 0) forces -= shift * block_product(mass, columns);
  return forces;
}

Eigen::MatrixXd PreconditionedInverse::multiply(const Eigen::MatrixXd& columns) const {
  return shifted_product(stiffness_, mass_, shift(), columns);
}

Eigen::MatrixXd PreconditionedInverse::gradient_solution(const Eigen::MatrixXd& right_hand_sides,
                                                         int max_iterations) const {
  return conjugate_gradients(
      ranks(), [&](const Eigen::MatrixXd& x) { return multiply(x); },
      [&](const Eigen::MatrixXd& r) { return precondition(r); }, right_hand_sides, {},
      max_iterations);
}

Eigen::MatrixXd PreconditionedInverse::precondition(const Eigen::MatrixXd& residuals) const {
  ++gradient_iterations_;
  return apply(residuals);
}

std::optional<EigenPairs> PreconditionedInverse::davidson_pairs(
    Mat mass, Eigen::Index count, const DavidsonLimits& limits) const {
  std::optional<DavidsonResult> result = block_davidson(
      ranks(), [&](const Eigen::MatrixXd& x) { return multiply(x); }, mass,
      [&](const Eigen::MatrixXd& r) { return apply(r); }, count, limits);
  davidson_iterations_ += result ? result->iterations : limits.max_iterations;
  if (!result) return std::nullopt;
  result->pairs.values.array() += shift();
  result->pairs.next += shift();
  return std::move(result->pairs);
}

std::string PreconditionedInverse::iterations_text() const {
  if (davidson_iterations_ + gradient_iterations_ == 0) return "";
  return "; " + std::to_string(davidson_iterations_) + " Davidson, " +
         std::to_string(gradient_iterations_) + " CG iterations";
}

}  // namespace flexneck::fe_modal
