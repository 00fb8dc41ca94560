// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/completeness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

/// Relative distance of eigenvalues between which sigma is well away from both.
constexpr double kGap = 1e-4;
/// Eigenvalues below this share of the shift are rigid-body motions.
constexpr double kRigidBody = 1e-6;

std::string hertz(double eigenvalue) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g Hz",
                std::sqrt(eigenvalue) / (2 * std::numbers::pi));
  return text.data();
}

}  // namespace

std::optional<std::string> prove_complete(const ModalSystem& system, const Eigen::VectorXd& values,
                                          Eigen::Index count, double shift) {
  for (Eigen::Index k = count; k < values.size(); ++k) {
    const bool rigid = values[k] <= kRigidBody * std::abs(shift);
    if (rigid || values[k] - values[k - 1] < kGap * values[k]) continue;
    const double sigma = (std::max(values[k - 1], 0.0) + values[k]) / 2;
    const Eigen::Index counted = system.eigenvalues_below(sigma);
    if (counted != k) {
      throw ComputationError("the eigensolver found " + std::to_string(k) + " modes below " +
                             hertz(sigma) + ", but the inertia of the stiffness counts " +
                             std::to_string(counted));
    }
    return "certified: no mode is missing below " + hertz(sigma) + ", by inertia";
  }
  return std::nullopt;
}

CertifiedModes certified_modes(const ModalSystem& system, const ShiftInverse& inverse,
                               Eigen::Index count) {
  PetscInt size = 0;
  require(MatGetSize(system.mass(), &size, nullptr), "asking for the number of modes");
  for (Eigen::Index more = 1;; more *= 2) {
    const Eigen::Index asked = std::min<Eigen::Index>(count + more, size);
    const EigenPairs pairs = lowest_eigenpairs(system.stiffness(), system.mass(), inverse, asked);
    auto certificate = prove_complete(system, pairs.values, count, inverse.shift());
    if (!certificate && asked == size) certificate = "certified: all modes that there are";
    if (certificate)
      return {{pairs.values.head(count), pairs.vectors.leftCols(count)}, *certificate};
  }
}

}  // namespace flexneck::fe_modal
