// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/numerics/weighted_elimination.h"

#include <algorithm>
#include <numeric>

namespace flexneck::multibody {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void WeightedElimination::factorise(const MatrixXd& Y) {
  Y_ = Y;
  order_.resize(static_cast<std::size_t>(Y.rows()));
  std::iota(order_.begin(), order_.end(), Index{0});
  const VectorXd sizes = Y.rowwise().lpNorm<Eigen::Infinity>();
  std::stable_sort(order_.begin(), order_.end(),
                   [&](Index a, Index b) { return sizes[a] > sizes[b]; });
  factors_.compute(Y(order_, Eigen::all));
}

/// With Y P = Q R: R^T (Q^T y)_1 = P^T s, the rest of Q^T y equals that of Q^T z, and R P^T lambda
/// = (Q^T z - Q^T y)_1.
void WeightedElimination::solve_once(VectorXd& z, VectorXd& s) const {
  const Index m = s.size();
  const auto R = factors_.matrixQR().topRows(m).triangularView<Eigen::Upper>();
  const auto& P = factors_.colsPermutation();
  VectorXd turned = factors_.householderQ().adjoint() * z(order_).eval();
  const VectorXd held = R.transpose().solve(VectorXd(P.transpose() * s));
  s = P * VectorXd(R.solve(turned.head(m) - held));
  turned.head(m) = held;
  z(order_) = factors_.householderQ() * turned;
}

/// Solves with one step of iterative refinement: the load on a light body is large compared with
/// the part of its motion that the joints leave free, which costs digits.
void WeightedElimination::solve(Eigen::Ref<VectorXd> z, Eigen::Ref<VectorXd> s) const {
  VectorXd y = z;
  VectorXd lambda = s;
  solve_once(y, lambda);
  VectorXd left = z - y - Y_ * lambda;
  VectorXd missing = s - Y_.transpose() * y;
  solve_once(left, missing);
  z = y + left;
  s = lambda + missing;
}

}  // namespace flexneck::multibody
