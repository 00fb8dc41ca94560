// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/model/nonnegative_least_squares.h"

#include <algorithm>
#include <vector>

#include <Eigen/QR>

namespace flexneck::pipeline {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Steps from x towards the free unknowns' least squares z, as far as none becomes negative;
/// unknowns that reach zero are no longer free.
void step_back(const VectorXd& z, std::vector<Index>& free, VectorXd& x) {
  double share = 1;
  for (std::size_t k = 0; k < free.size(); ++k) {
    const double to = z[static_cast<Index>(k)];
    if (to <= 0) share = std::min(share, x[free[k]] / (x[free[k]] - to));
  }
  for (std::size_t k = 0; k < free.size(); ++k) {
    double& value = x[free[k]];
    const double to = z[static_cast<Index>(k)];
    const bool ends = to <= 0 && value / (value - to) <= share;
    value = ends ? 0 : value + share * (to - value);
  }
  std::erase_if(free, [&](Index k) { return x[k] == 0; });
}

}  // namespace

VectorXd nonnegative_least_squares(const MatrixXd& A, const VectorXd& b) {
  const Index n = A.cols();
  const double none = 1e-13 * A.norm() * b.norm();  // threshold for a gradient
  VectorXd x = VectorXd::Zero(n);
  std::vector<Index> free;
  // Each round has another set of free unknowns and a smaller residual; the bound is for rounding.
  for (Index round = 0; round < 10 * n; ++round) {
    VectorXd gradient = A.transpose() * (b - A * x);
    for (const Index k : free) gradient[k] = 0;
    Index largest = 0;
    if (!(gradient.maxCoeff(&largest) > none)) break;
    free.push_back(largest);
    while (!free.empty()) {
      MatrixXd columns(A.rows(), static_cast<Index>(free.size()));
      for (std::size_t k = 0; k < free.size(); ++k)
        columns.col(static_cast<Index>(k)) = A.col(free[k]);
      const VectorXd z = columns.colPivHouseholderQr().solve(b);
      if (z.minCoeff() > 0) {
        for (std::size_t k = 0; k < free.size(); ++k) x[free[k]] = z[static_cast<Index>(k)];
        break;
      }
      step_back(z, free, x);
    }
  }
  return x;
}

}  // namespace flexneck::pipeline
