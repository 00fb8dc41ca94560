// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/analysis/linearisation.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include <Eigen/Eigenvalues>

#include "geometry/foundation/error.h"

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Fraction of the largest stiffness below which a squared eigenvalue is only an error of the
/// finite differences.
constexpr double kZero = 1e-9;
/// Fraction of the fastest rate below which a growth rate is only such an error.
constexpr double kGrowth = 3e-7;

struct RealEigenvalue {
  double value;
  VectorXd shape;  ///< unit vector
  bool used = false;
};

SystemMode mode_of_pair(double l1, double l2) {
  const double growth = std::max({l1, l2, 0.0});
  if (l1 * l2 <= 0) return {0, 0, 0, growth};
  const double omega = std::sqrt(l1 * l2);
  return {omega / (2 * std::numbers::pi), 0, -(l1 + l2) / (2 * omega), growth};
}

/// Pairs real eigenvalues to overdamped modes. The two of a mode have the same shape, at least if
/// the damping does not couple the modes: each takes the most similar partner, slowest first. A
/// single one that is left over is paired with zero.
std::vector<Eigenmode> overdamped_modes(std::vector<RealEigenvalue> values) {
  std::sort(values.begin(), values.end(),
            [](const auto& a, const auto& b) { return std::abs(a.value) < std::abs(b.value); });
  std::vector<Eigenmode> modes;
  for (std::size_t first = 0; first < values.size(); ++first) {
    if (values[first].used) continue;
    std::size_t partner = values.size();
    double best = -1;
    for (std::size_t k = first + 1; k < values.size(); ++k) {
      const double similarity = std::abs(values[first].shape.dot(values[k].shape));
      if (values[k].used || similarity <= best) continue;
      best = similarity;
      partner = k;
    }
    RealEigenvalue& slow = values[first];
    if (partner == values.size()) {
      if (slow.value > 0) modes.push_back({mode_of_pair(slow.value, 0), slow.shape});
      break;
    }
    RealEigenvalue& fast = values[partner];
    slow.used = fast.used = true;
    const bool moves_away = slow.value < 0 && fast.value > 0;
    modes.push_back({mode_of_pair(slow.value, fast.value), moves_away ? fast.shape : slow.shape});
  }
  return modes;
}

}  // namespace

std::vector<Eigenmode> eigenmodes_of(const MatrixXd& A, Index positions, Index internal) {
  const Index rates = A.rows() - positions - internal;
  if (rates == 0) return {};
  // Time is scaled so that the largest stiffness is one.
  const double largest = A.block(positions, 0, rates, positions).cwiseAbs().maxCoeff();
  const double rate = largest > 0 ? std::sqrt(largest) : 1.0;
  MatrixXd scaled = A / rate;
  scaled.block(0, positions, positions, rates) *= rate;
  scaled.block(positions, 0, rates, positions) /= rate;
  scaled.block(positions, positions + rates, rates, internal) /= rate;
  const Eigen::EigenSolver<MatrixXd> eigen(scaled);
  if (eigen.info() != Eigen::Success)
    throw ComputationError("the eigenvalues of the linearised system did not converge");

  std::vector<Eigenmode> modes;
  std::vector<RealEigenvalue> real;
  for (Index i = 0; i < A.rows(); ++i) {
    const std::complex<double> lambda = eigen.eigenvalues()[i];
    const double magnitude = std::abs(lambda);
    if (magnitude * magnitude < kZero) continue;
    const Eigen::VectorXcd shape = eigen.eigenvectors().col(i).head(positions);
    const double growth = lambda.real() > kGrowth ? lambda.real() * rate : 0;
    if (lambda.imag() > 0)
      modes.push_back(
          {{magnitude * rate / (2 * std::numbers::pi),
            lambda.imag() * rate / (2 * std::numbers::pi), -lambda.real() / magnitude, growth},
           shape});
    if (lambda.imag() == 0) real.push_back({lambda.real() * rate, shape.real().normalized()});
  }
  if (internal == 0) {
    for (Eigenmode& mode : overdamped_modes(std::move(real))) modes.push_back(std::move(mode));
    modes.resize(static_cast<std::size_t>(rates));  // the others have no restoring force
  } else {
    for (const RealEigenvalue& each : real)
      if (each.value > kGrowth * rate) modes.push_back({mode_of_pair(each.value, 0), each.shape});
  }
  std::stable_sort(modes.begin(), modes.end(), [](const Eigenmode& a, const Eigenmode& b) {
    return a.mode.frequency_Hz < b.mode.frequency_Hz;
  });
  return modes;
}

std::vector<SystemMode> modes_of(const MatrixXd& stiffness, const MatrixXd& damping) {
  const Index k = stiffness.rows();
  std::vector<SystemMode> modes;
  for (const Eigenmode& each : eigenmodes_of(second_order(stiffness, damping), k))
    modes.push_back(each.mode);
  return modes;
}

MatrixXd second_order(const MatrixXd& stiffness, const MatrixXd& damping) {
  const Index k = stiffness.rows();
  MatrixXd A = MatrixXd::Zero(2 * k, 2 * k);
  A.topRightCorner(k, k).setIdentity();
  A.bottomLeftCorner(k, k) = -stiffness;
  A.bottomRightCorner(k, k) = -damping;
  return A;
}

}  // namespace flexneck::multibody
