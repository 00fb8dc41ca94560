// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/campaigns/dense_truth.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "fe_modal/analysis/modal_analysis.h"
#include "geometry/foundation/error.h"
#include "tests/fe_modal/dense_constraints.h"

namespace flexneck::campaigns {
namespace {

using namespace fe_modal;

/// Relative tolerance of eigenvalues: the dense ones have rounding errors, though their mass and
/// stiffness are scaled.
constexpr double kSame = 1e-6;
/// Fraction of the material's (c / L)^2 below which an eigenvalue is zero.
constexpr double kZero = 1e-9;
/// Fraction of it to which an eigenvalue is exact at best: stiffnesses are a thousand times the
/// scale.
constexpr double kRounding = 1e-12;

struct Truth {
  Eigen::VectorXd values;  ///< 1/s^2, ascending
  Eigen::Index zeros = 0;
};

/// The lowest dense eigenvalues of a mesh.
/// @param scale  the material's (c / L)^2
Truth dense_truth(const mesher::Mesh& mesh, double size_m, double scale, Eigen::Index count) {
  DenseConstraints model = dense_model(mesh);
  const Eigen::Index size = model.stiffness.rows();
  // Rotations are scaled to lengths, and equations to unit size.
  Eigen::VectorXd units = Eigen::VectorXd::Ones(size);
  const auto nodes = static_cast<Eigen::Index>(mesh.nodes.size());
  for (Eigen::Index point = nodes; 3 * point < size; point += 2)
    units.segment<3>(3 * point + 3).setConstant(1 / size_m);
  for (Eigen::VectorXd& row : model.equations) row = row.cwiseProduct(units).normalized();
  const Eigen::MatrixXd basis = units.asDiagonal() * allowed_motions(model);
  const Eigen::MatrixXd mass = basis.transpose() * model.mass * basis;
  Eigen::MatrixXd stiffness = basis.transpose() * model.stiffness * basis;
  const Eigen::VectorXd shifted =
      testing::lowest_values(stiffness + scale * mass, mass, std::min(count, mass.rows()));
  Truth truth{shifted.array() - scale, 0};
  truth.zeros = (truth.values.array() < kZero * scale).count();
  if (truth.zeros == 0)
    truth.values = testing::lowest_values(stiffness, mass, std::min(count, mass.rows()));
  return truth;
}

bool says(const std::string& text, const char* words) {
  return text.find(words) != std::string::npos;
}

bool is_refusal_of_input(const std::string& text) {
  return says(text, "contradict each other") || says(text, "form a cycle") ||
         says(text, "on the axis of") || says(text, "carries a mass with an unconstrained motion");
}

/// Fraction of the scale below which an eigenvalue may be lost in rounding, like a mechanism's.
constexpr double kLost = 1e-10;

/// Returns whether some motion has so little stiffness that the body may be called a mechanism.
bool moves_softly(const mesher::Mesh& mesh, double size_m, double scale, Eigen::Index count) {
  const Truth truth = dense_truth(mesh, size_m, scale, count);
  return truth.zeros < truth.values.size() && truth.values[truth.zeros] < kLost * scale;
}

Eigen::Index independent(const mesher::Mesh& mesh) {
  const DofMap dof_map(mesh, {});
  return dof_map.dof_count() - dof_map.dependent_count();
}

}  // namespace

std::optional<std::string> compare_modes(Case& drawn, const mesher::Mesh& given,
                                         const mesher::Mesh& meant, double size_m) {
  const mesher::Material& material = meant.materials[0];
  const double wave_1_s2 = material.youngs_modulus_Pa / material.density_kg_m3 / (size_m * size_m);
  ModalOptions options;
  ModalBody found;
  std::ostringstream problem;
  try {
    options.mode_count = static_cast<int>(std::min<Eigen::Index>(8, independent(given)));
    if (options.mode_count == 0) return std::nullopt;  // nothing moves
    found = analyse_modes(given, options, {});
  } catch (const InputError& error) {
    const bool is_soft = says(error.what(), "the body is a mechanism") &&
                         moves_softly(meant, size_m, wave_1_s2, options.mode_count);
    if (!is_soft && !is_refusal_of_input(error.what())) throw;
    drawn.was_refused = true;
    return std::nullopt;
  } catch (const ComputationError& error) {
    // The frequencies are too far apart for the digits of a solve, as the message says.
    if (says(error.what(), "has not converged") ||
        (says(error.what(), "too close to singular") &&
         moves_softly(meant, size_m, wave_1_s2, options.mode_count))) {
      drawn.was_refused = true;
      return std::nullopt;
    }
    problem << error.what() << "; expected "
            << dense_truth(meant, size_m, wave_1_s2, options.mode_count).values.transpose();
    return problem.str();
  }
  const Truth truth = dense_truth(meant, size_m, wave_1_s2, options.mode_count);
  const Eigen::VectorXd values = (2 * std::numbers::pi * found.frequencies_Hz.array()).square();
  const Eigen::Index zeros = (values.array() == 0).count();
  // An eigenvalue that is small but not zero, as with a soft spring, is the same in both.
  const auto is_same = [&](Eigen::Index k) {
    return std::abs(values[k] - truth.values[k]) <= 0.1 * truth.values[k];
  };
  bool are_zeros_same = zeros <= truth.zeros;
  for (Eigen::Index k = zeros; k < truth.zeros; ++k) are_zeros_same = are_zeros_same && is_same(k);
  if (!are_zeros_same) {
    problem << zeros << " rigid motions, expected " << truth.zeros << "; lowest "
            << truth.values.transpose() << "; " << found.boundary;
    return problem.str();
  }
  const double rounding = (truth.zeros > 0 ? kZero : kRounding) * wave_1_s2;
  for (Eigen::Index k = zeros; k < values.size(); ++k) {
    const double off = std::abs(values[k] - truth.values[k]);
    if (off <= kSame * truth.values[k] + rounding) continue;
    problem << "eigenvalue " << k << " is " << values[k] << ", expected " << truth.values[k];
    return problem.str();
  }
  return std::nullopt;
}

}  // namespace flexneck::campaigns
