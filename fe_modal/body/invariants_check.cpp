// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/body/invariants_check.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "fe_modal/body/identity.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

/// Returns int rho p q^T from -int rho ~p ~q.
Eigen::Matrix3d products_of(const Eigen::Matrix3d& inertia_integral) {
  return inertia_integral.trace() / 2 * Eigen::Matrix3d::Identity() - inertia_integral.transpose();
}

/// Returns int rho p x q from -int rho ~p ~q.
Eigen::Vector3d cross_integral(const Eigen::Matrix3d& inertia_integral) {
  const Eigen::Matrix3d& g = inertia_integral;
  return {g(1, 2) - g(2, 1), g(2, 0) - g(0, 2), g(0, 1) - g(1, 0)};
}

std::string entry_of(std::size_t j, std::size_t l) {
  return entry_text(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(l));
}

/// Checks the identities of G and N for a pair of modes.
void check_pair(const InertiaInvariants& inertia, std::size_t j, std::size_t l, double rounding) {
  const auto m = static_cast<std::size_t>(inertia.Maa.rows());
  const std::string here = entry_of(j, l);
  const std::string there = entry_of(l, j);
  const Eigen::Matrix3d& g = inertia.G[j * m + l];
  const Eigen::Vector3d& n = inertia.N[j * m + l];
  require_identity("/invariants/G", here + " is the transpose of " + there,
                   (g - inertia.G[l * m + j].transpose()).cwiseAbs().maxCoeff(), rounding);
  require_identity(
      "/invariants/G", "half the trace of " + here + " is that entry of Maa",
      g.trace() / 2 - inertia.Maa(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(l)),
      kMassNormalised);
  require_identity("/invariants/N", here + " is minus " + there,
                   (n + inertia.N[l * m + j]).cwiseAbs().maxCoeff(), rounding);
  require_identity("/invariants/N", here + " has the antisymmetric part of G" + here,
                   (n - cross_integral(g)).cwiseAbs().maxCoeff(), 2 * rounding);
}

/// Matrix of int rho p q of the scalar fields 1, the components of s0, those of psi_0, …; s0 is
/// scaled so that int rho |s0|^2 = 1, and 1 so that the mass is 1.
Eigen::MatrixXd gram_matrix(const InertiaInvariants& inertia, double length) {
  const auto m = inertia.Maa.rows();
  const double root_mass = std::sqrt(inertia.mass);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(4 + 3 * m, 4 + 3 * m);
  gram(0, 0) = 1;
  gram.block<3, 1>(1, 0) = inertia.S1 / (root_mass * length);
  gram.block<3, 3>(1, 1) = products_of(inertia.J0) / (length * length);
  for (Eigen::Index l = 0; l < m; ++l) {
    gram.block<3, 1>(4 + 3 * l, 0) = inertia.S2.col(l) / root_mass;
    gram.block<3, 3>(4 + 3 * l, 1) =
        products_of(inertia.G0[static_cast<std::size_t>(l)]).transpose() / length;
    for (Eigen::Index j = l; j < m; ++j) {
      gram.block<3, 3>(4 + 3 * j, 4 + 3 * l) =
          products_of(inertia.G[static_cast<std::size_t>(j * m + l)]);
    }
  }
  return gram.selfadjointView<Eigen::Lower>();
}

/// Checks that the matrix is positive, block after block, so that the message names the one in
/// error.
void check_gram(const Eigen::MatrixXd& gram, double rounding) {
  const Eigen::Index size = gram.rows();
  const double allowed = static_cast<double>(size) * rounding;
  require_positive("/invariants/J0", "the matrix of the second moments of mass, S1 and J0",
                   gram.topLeftCorner<4, 4>(), allowed);
  require_positive("/invariants/G", "the mass matrix of the modes' components",
                   gram.bottomRightCorner(size - 4, size - 4), allowed);
  std::vector<Eigen::Index> without_positions = {0};
  for (Eigen::Index k = 4; k < size; ++k) without_positions.push_back(k);
  require_positive("/invariants/S2", "the mass matrix of translations and modes",
                   gram(without_positions, without_positions), allowed);
  require_positive("/invariants/G0", "the mass matrix of translations, rotations and modes", gram,
                   allowed);
}

}  // namespace

double rounding_of_sums(Eigen::Index n) {
  constexpr double kCoupled = 100;
  constexpr double kFacets = 2;
  return kFacets * (static_cast<double>(n) + kCoupled) * std::numeric_limits<double>::epsilon();
}

void check_invariants(const InertiaInvariants& inertia, double rounding) {
  const auto m = static_cast<std::size_t>(inertia.Maa.rows());
  const auto identity = Eigen::MatrixXd::Identity(inertia.Maa.rows(), inertia.Maa.cols());
  if (!(inertia.mass > 0)) throw InputError("/invariants/mass: the mass is not positive");
  if ((inertia.Maa - identity).cwiseAbs().maxCoeff() > kMassNormalised) {
    throw InputError("/invariants/Maa: the modes are not mass-normalised, expected the identity");
  }
  const double second_moment = inertia.J0.trace() / 2;
  if (!(second_moment > 0)) {
    throw InputError("/invariants/J0: expected moments of inertia, whose sum is positive");
  }
  require_symmetric("/invariants/J0", inertia.J0, rounding * second_moment);
  const double length = std::sqrt(second_moment);
  for (std::size_t l = 0; l < m; ++l) {
    const auto column = static_cast<Eigen::Index>(l);
    require_identity("/invariants/N0",
                     "column " + std::to_string(l) + " has the antisymmetric part of G0[" +
                         std::to_string(l) + "]",
                     (inertia.N0.col(column) - cross_integral(inertia.G0[l])).cwiseAbs().maxCoeff(),
                     2 * rounding * length);
    for (std::size_t j = 0; j <= l; ++j) check_pair(inertia, j, l, rounding);
  }
  check_gram(gram_matrix(inertia, length), rounding);
}

}  // namespace flexneck::fe_modal
