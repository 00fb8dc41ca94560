// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include <Eigen/SparseCore>

#include "multibody/numerics/small_lu.h"

namespace flexneck::multibody {

/// LU factors of a sparse matrix whose entries keep their places: dense ones of a small matrix, of
/// which nothing is allocated after construction, sparse ones of a larger one.
class LuFactors {
 public:
  /// From as many unknowns on sparse factors are faster, those of a chain of bodies
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
  std::unique_ptr<Sparse> sparse_;  ///< in place of `dense_`
};

}  // namespace flexneck::multibody
