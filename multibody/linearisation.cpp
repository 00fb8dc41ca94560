// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/linearisation.h"

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

/// A squared eigenvalue below this share of the largest stiffness is what differences leave of
/// zero.
constexpr double kZero = 1e-9;

struct RealEigenvalue {
  double value;
  VectorXd shape;  ///< unit vector
  bool used = false;
};

SystemMode mode_of_pair(double l1, double l2) {
  const double omega = std::sqrt(l1 * l2);
  return {omega / (2 * std::numbers::pi), 0, -(l1 + l2) / (2 * omega)};
}

/// The eigenvalues of an overdamped mode share their shape, at least when the damping does not
/// couple the modes: each takes the most similar partner, slowest first.
std::vector<SystemMode> overdamped_modes(std::vector<RealEigenvalue> values) {
  std::sort(values.begin(), values.end(),
            [](const auto& a, const auto& b) { return std::abs(a.value) < std::abs(b.value); });
  std::vector<SystemMode> modes;
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
    if (partner == values.size()) break;
    values[first].used = values[partner].used = true;
    modes.push_back(mode_of_pair(values[first].value, values[partner].value));
  }
  return modes;
}

}  // namespace

std::vector<SystemMode> modes_of(const MatrixXd& stiffness, const MatrixXd& damping) {
  const Index k = stiffness.rows();
  if (k == 0) return {};
  // In units of time that make the largest stiffness one.
  const double largest = stiffness.cwiseAbs().maxCoeff();
  const double rate = largest > 0 ? std::sqrt(largest) : 1.0;
  MatrixXd system = MatrixXd::Zero(2 * k, 2 * k);
  system.topRightCorner(k, k).setIdentity();
  system.bottomLeftCorner(k, k) = -stiffness / (rate * rate);
  system.bottomRightCorner(k, k) = -damping / rate;
  const Eigen::EigenSolver<MatrixXd> eigen(system);
  if (eigen.info() != Eigen::Success)
    throw ComputationError("the eigenvalues of the linearised system did not converge");

  std::vector<SystemMode> modes;
  std::vector<RealEigenvalue> real;
  for (Index i = 0; i < 2 * k; ++i) {
    const std::complex<double> lambda = eigen.eigenvalues()[i];
    const double magnitude = std::abs(lambda);
    if (magnitude * magnitude < kZero) continue;
    if (lambda.real() > std::sqrt(kZero) * 1e-2)
      throw ComputationError("the equilibrium found is not stable: a motion about it grows");
    if (lambda.imag() > 0)
      modes.push_back({magnitude * rate / (2 * std::numbers::pi),
                       lambda.imag() * rate / (2 * std::numbers::pi), -lambda.real() / magnitude});
    if (lambda.imag() == 0)
      real.push_back(
          {lambda.real() * rate, eigen.eigenvectors().col(i).head(k).real().normalized()});
  }
  for (const SystemMode& mode : overdamped_modes(std::move(real))) modes.push_back(mode);
  modes.resize(static_cast<std::size_t>(k));  // the rest have no restoring force
  std::sort(modes.begin(), modes.end(), [](const SystemMode& a, const SystemMode& b) {
    return a.frequency_Hz < b.frequency_Hz;
  });
  return modes;
}

}  // namespace flexneck::multibody
