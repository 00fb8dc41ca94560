// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace flexneck::multibody {

/// P A = L U with row pivoting, for some tens of unknowns: Eigen's blocked algorithm, made for
/// large matrices, takes three times as long there. Allocates nothing after construction.
class SmallLu {
 public:
  explicit SmallLu(Eigen::Index size)
      : factors_(size, size), pivots_(static_cast<std::size_t>(size)) {}

  /// The matrix to fill before factorise().
  Eigen::MatrixXd& matrix() { return factors_; }

  /// Factorises the matrix; solutions with a singular one are not finite.
  void factorise() {
    const Eigen::Index n = factors_.rows();
    for (Eigen::Index k = 0; k < n; ++k) {
      Eigen::Index pivot = k;
      for (Eigen::Index i = k + 1; i < n; ++i)
        if (std::abs(factors_(i, k)) > std::abs(factors_(pivot, k))) pivot = i;
      pivots_[static_cast<std::size_t>(k)] = pivot;
      if (pivot != k) factors_.row(k).swap(factors_.row(pivot));
      const double scale = 1 / factors_(k, k);
      double* const column = &factors_(0, k);
      for (Eigen::Index i = k + 1; i < n; ++i) column[i] *= scale;
      for (Eigen::Index j = k + 1; j < n; ++j) subtract(&factors_(0, j), column, k + 1, n);
      column[k] = scale;  // solve() needs the inverse of U's diagonal
    }
  }

  /// values <- A^-1 values
  void solve(Eigen::VectorXd& values) const {
    const Eigen::Index n = factors_.rows();
    double* const x = values.data();
    for (Eigen::Index k = 0; k < n; ++k) {
      std::swap(x[k], x[pivots_[static_cast<std::size_t>(k)]]);
    }
    for (Eigen::Index k = 0; k < n; ++k) subtract(x, &factors_(0, k), k + 1, n, x[k]);
    for (Eigen::Index k = n; k-- > 0;) {
      x[k] *= factors_(k, k);
      subtract(x, &factors_(0, k), 0, k, x[k]);
    }
  }

 private:
  /// Computes to -= factor from, in the rows from `first` on; the factor is the column's entry in
  /// the row before.
  static void subtract(double* to, const double* from, Eigen::Index first, Eigen::Index end) {
    subtract(to, from, first, end, to[first - 1]);
  }
  static void subtract(double* __restrict__ to, const double* __restrict__ from, Eigen::Index first,
                       Eigen::Index end, double factor) {
    for (Eigen::Index i = first; i < end; ++i) to[i] -= factor * from[i];
  }

  Eigen::MatrixXd factors_;
  std::vector<Eigen::Index> pivots_;
};

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
