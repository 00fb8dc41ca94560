// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include <Eigen/SparseCore>

#include "multibody/numerics/small_lu.h"

namespace flexneck::multibody {

/// LU factors of a sparse matrix with a fixed pattern: dense factors of a small matrix, which
/// allocate nothing after construction, sparse factors of a larger one.
class LuFactors {
 public:
  /// Number of unknowns from which sparse factors are faster, for a chain of bodies
  /// (tests/benchmarks/README.md).
  static constexpr Eigen::Index kSparse = 100;

  explicit LuFactors(Eigen::Index size);
  ~LuFactors();
  LuFactors(LuFactors&&) noexcept;
  LuFactors& operator=(LuFactors&&) noexcept;

  /// Factorises a matrix; solutions with a singular one are not finite.
  void factorise(const Eigen::SparseMatrix<double>& matrix);
  /// values <- A^-1 values
  void solve(Eigen::VectorXd& values) const;

 private:
  struct Sparse;

  SmallLu dense_;
  std::unique_ptr<Sparse> sparse_;  ///< used instead of `dense_`
};

}  // namespace flexneck::multibody
