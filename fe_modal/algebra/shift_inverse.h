// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "fe_modal/algebra/eigen_pairs.h"
#include "fe_modal/algebra/petsc_handles.h"

namespace flexneck::fe_modal {

/// (K - shift M)^-1 as an operator, whoever makes it: a factor here, one shared among ranks, or an
/// iteration. Vectors are sequential, N degrees of freedom.
class ShiftInverse {
 public:
  explicit ShiftInverse(double shift) : shift_(shift) {}
  virtual ~ShiftInverse() = default;
  ShiftInverse(const ShiftInverse&) = delete;
  ShiftInverse& operator=(const ShiftInverse&) = delete;

  double shift() const { return shift_; }
  /// @throws ComputationError if the solver fails.
  virtual void solve(Vec right_hand_side, Vec solution) const = 0;
  /// For each column, (N, k).
  virtual Eigen::MatrixXd solve(const Eigen::MatrixXd& right_hand_sides) const = 0;
  /// Near that, symmetric and positive definite: all that conjugate gradients need.
  virtual Eigen::MatrixXd precondition(const Eigen::MatrixXd& residuals) const {
    return solve(residuals);
  }
  /// The lowest eigenpairs of K x = lambda M x by a method of its own, where solves are dear;
  /// nothing where a Krylov method serves.
  virtual std::optional<EigenPairs> iterate(Mat /*mass*/, Eigen::Index /*count*/) const {
    return std::nullopt;
  }
  /// What was made and done, for the user: "the factor has 12.3 million entries".
  virtual std::string describe() const = 0;

 private:
  double shift_;
};

}  // namespace flexneck::fe_modal
