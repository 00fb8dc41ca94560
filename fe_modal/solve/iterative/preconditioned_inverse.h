// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "fe_modal/algebra/shift_inverse.h"
#include "fe_modal/solve/iterative/block_davidson.h"

namespace flexneck::fe_modal {

/// (K - shift M) times each column.
Eigen::MatrixXd shifted_product(Mat stiffness, Mat mass, double shift,
                                const Eigen::MatrixXd& columns);

/// (K - shift M)^-1 by iteration with a preconditioner near it: conjugate gradients for solutions,
/// block Davidson for modes. Stiffness and mass are multiplied with in double precision, so that
/// the preconditioner's may be a lower one.
class PreconditionedInverse : public ShiftInverse {
 public:
  /// @param stiffness, mass of the body, for products; must outlive this
  PreconditionedInverse(Mat stiffness, Mat mass, double shift, const Ranks& ranks = {})
      : ShiftInverse(shift, ranks), stiffness_(stiffness), mass_(mass) {}

  Eigen::MatrixXd precondition(const Eigen::MatrixXd& residuals) const override;

 protected:
  /// By conjugate gradients.
  /// @throws ComputationError if so many iterations do not find it.
  Eigen::MatrixXd gradient_solution(const Eigen::MatrixXd& right_hand_sides,
                                    int max_iterations) const;
  /// The lowest pairs by the block Davidson method, if it finds them.
  std::optional<EigenPairs> davidson_pairs(Mat mass, Eigen::Index count,
                                           const DavidsonLimits& limits) const;
  /// (K - shift M) x
  Eigen::MatrixXd multiply(const Eigen::MatrixXd& columns) const;
  /// The preconditioner times each column.
  virtual Eigen::MatrixXd apply(const Eigen::MatrixXd& residuals) const = 0;
  /// "; 8 Davidson, 12 CG iterations", of all until now: block Davidson and conjugate gradients.
  std::string iterations_text() const;

 private:
  Mat stiffness_;
  Mat mass_;
  mutable int davidson_iterations_ = 0;
  mutable int gradient_iterations_ = 0;
};

}  // namespace flexneck::fe_modal
