// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/model/slit_gaps.h"

#include <algorithm>
#include <string>
#include <vector>

#include <Eigen/Cholesky>

#include "geometry/foundation/error.h"

namespace flexneck::multibody {

using Eigen::Index;
using Eigen::VectorXd;

namespace {
constexpr double kRounding = 1e-13;
constexpr int kMostPivots = 10000;  ///< a few gaps need so many only because of rounding
}  // namespace

VectorXd least_openings(const Eigen::MatrixXd& A, const VectorXd& r) {
  if (!r.allFinite()) return r;  // a diverged run shows this in its loads
  if (!(r.array() < 0).any()) return VectorXd::Zero(r.size());
  std::vector<Index> open;
  for (Index k = 0; k < r.size(); ++k)
    if (r[k] < 0) open.push_back(k);
  for (int pivot = 0; pivot < kMostPivots; ++pivot) {
    VectorXd g = VectorXd::Zero(r.size());
    if (!open.empty()) g(open) = -A(open, open).llt().solve(r(open));
    // Forces on closed gaps over the largest load, and openings over the largest opening.
    VectorXd allowed = (A * g + r) / r.cwiseAbs().maxCoeff();
    if (!open.empty()) allowed(open) = g(open) / g.cwiseAbs().maxCoeff();
    Index k = 0;
    while (k < r.size() && allowed[k] >= -kRounding) ++k;
    if (k == r.size()) return g.cwiseMax(0.0);
    const auto found = std::find(open.begin(), open.end(), k);
    if (found == open.end()) {
      open.push_back(k);
    } else {
      open.erase(found);
    }
  }
  throw ComputationError("the openings of the slits did not converge after " +
                         std::to_string(kMostPivots) + " pivoting steps");
}

VectorXd SlitGaps::openings_m(const VectorXd& from_rest) const {
  return least_openings(stiffness, coupling * from_rest);
}

}  // namespace flexneck::multibody
