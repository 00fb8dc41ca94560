// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "fe_modal/algebra/eigen_pairs.h"
#include "fe_modal/algebra/petsc_handles.h"

namespace flexneck::fe_modal {

/// (K - shift M)^-1 as an operator, whoever makes it: a factor here, one on all ranks, or an
/// iteration. Vectors are this rank's rows; every member but the plain ones is collective.
class ShiftInverse {
 public:
  explicit ShiftInverse(double shift, const Ranks& ranks = {}) : shift_(shift), ranks_(ranks) {}
  virtual ~ShiftInverse() = default;
  ShiftInverse(const ShiftInverse&) = delete;
  ShiftInverse& operator=(const ShiftInverse&) = delete;

  double shift() const { return shift_; }
  const Ranks& ranks() const { return ranks_; }
  /// For each column, (own dofs, k).
  /// @throws ComputationError if the solver fails.
  virtual Eigen::MatrixXd solve(const Eigen::MatrixXd& right_hand_sides) const = 0;
  /// The same for solutions that are nearly exact: an iteration takes but a step.
  virtual Eigen::MatrixXd improve(const Eigen::MatrixXd& right_hand_sides,
                                  const Eigen::MatrixXd& /*solutions*/) const {
    return solve(right_hand_sides);
  }
  /// The same to a digit or more, where that is cheaper: enough for a part of a preconditioner.
  virtual Eigen::MatrixXd approximate(const Eigen::MatrixXd& right_hand_sides) const {
    return solve(right_hand_sides);
  }
  /// Near that, symmetric and positive definite: all that conjugate gradients need.
  virtual Eigen::MatrixXd precondition(const Eigen::MatrixXd& residuals) const {
    return solve(residuals);
  }
  /// The lowest eigenpairs of K x = lambda M x by a method of its own, where solves are dear;
  /// nothing where a Krylov method serves.
  virtual std::optional<EigenPairs> iterate(Mat /*mass*/, Eigen::Index /*count*/) const {
    return std::nullopt;
  }
  /// Whether the matrix may be singular and only rounding errors keep it from showing.
  virtual bool is_doubtful() const { return false; }
  /// What was made and done, for the user: "the factor has 12.3 million entries".
  virtual std::string describe() const = 0;

 private:
  double shift_;
  Ranks ranks_;
};

/// y = (K - shift M)^-1 x for vectors of PETSc.
void solve(const ShiftInverse& inverse, Vec right_hand_side, Vec solution);

}  // namespace flexneck::fe_modal
