// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace flexneck::multibody {

/// Minimum of an energy g^T A g / 2 + r^T g over gaps g >= 0, A positive definite: among all
/// choices of closed gaps the one in which no other gap would open or overlap.
template <int kGaps>
class LeastGaps {
 public:
  using Matrix = Eigen::Matrix<double, kGaps, kGaps>;
  using Vector = Eigen::Matrix<double, kGaps, 1>;

  /// @param tried_first  a choice, with a bit for each open gap, such as the last found: the
  /// minimum is unique, so that it changes the work and not the result
  LeastGaps(const Matrix& A, const Vector& r, int tried_first) {
    double least = std::numeric_limits<double>::infinity();
    constexpr int kAll = 1 << kGaps;
    tried_first &= kAll - 1;
    if (is_least(A, r, tried_first, least)) return;
    for (int open = 0; open < kAll; ++open)
      if (open != tried_first && is_least(A, r, open, least)) return;
  }

  Vector openings_m = Vector::Zero();
  int which_open = 0;  ///< one bit for each gap
  /// Distance of the first gap from opening or closing, m: an opening, or the indentation by a
  /// force.
  double to_next_m = 0;

 private:
  static bool is_open(int open, int gap) { return (open >> gap & 1) != 0; }

  /// Keeps the choice with the smallest violation.
  /// @return true if it violates nothing
  bool is_least(const Matrix& A, const Vector& r, int open, double& least) {
    const Vector g = with_open(A, r, open);
    const Vector force = A * g + r;
    double violation = 0;  // as an energy, so that openings and forces are comparable
    double to_next = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kGaps; ++k) {
      const double room_m = is_open(open, k) ? g[k] : force[k] / A(k, k);
      const double wrong_m = std::min(0.0, room_m);
      to_next = std::min(to_next, room_m);
      violation = std::max(violation, wrong_m * wrong_m * A(k, k));
    }
    if (violation >= least) return false;
    to_next_m = to_next;
    least = violation;
    openings_m = g.cwiseMax(0.0);
    which_open = open;
    return violation == 0;
  }

  static Vector with_open(Matrix A, Vector r, int open) {
    if (open == 0) return Vector::Zero();
    for (int k = 0; k < kGaps; ++k) {
      if (is_open(open, k)) continue;
      A.row(k).setZero();
      A.col(k).setZero();
      A(k, k) = 1;
      r[k] = 0;
    }
    return -A.llt().solve(r);
  }
};

}  // namespace flexneck::multibody
