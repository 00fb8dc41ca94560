// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "pipeline/language/study/sweep_section.h"

namespace flexneck::pipeline {

/// Phi of each score, in the open interval (0, 1).
Eigen::VectorXd probabilities(const Eigen::VectorXd& scores);

/// Correlation of normal scores, a Gaussian copula: u = Phi(z) with z normal and correlated has
/// uniform coordinates, so each parameter keeps its own distribution.
class Correlation {
 public:
  /// @throws InputError if the coefficients contradict each other: no positive definite matrix.
  explicit Correlation(const SweepSection& sweep);

  bool is_none() const { return is_none_; }
  const Eigen::MatrixXd& matrix() const { return matrix_; }
  /// Converts independent coordinates of the open unit cube to correlated ones.
  Eigen::VectorXd correlated(const Eigen::VectorXd& independent) const;
  /// Redraws the scores at `free`, given the others.
  /// @param normal  independent standard normal numbers, as many as scores
  Eigen::VectorXd redrawn(const Eigen::VectorXd& scores, const std::vector<Eigen::Index>& free,
                          const Eigen::VectorXd& normal) const;
  /// Factor L with L L^T = matrix().
  const Eigen::MatrixXd& factor() const { return factor_; }

 private:
  bool is_none_ = true;
  Eigen::MatrixXd matrix_;
  Eigen::MatrixXd factor_;
};

}  // namespace flexneck::pipeline
