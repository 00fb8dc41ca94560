// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/body/mode_count_study.h"

#include <algorithm>
#include <numbers>

#include "fe_modal/body/basis_kind.h"
#include "fe_modal/body/independent_loads.h"
#include "geometry/foundation/symmetric_pairs.h"

namespace flexneck::fe_modal {
namespace {

using Indices = std::vector<Eigen::Index>;

constexpr Eigen::Index kFrequencies = 6;

struct Choice {
  std::string label;
  Indices modes;
};

std::vector<Choice> choices_of(const ModalBody& body) {
  Indices normal;
  Indices bending;
  for (Eigen::Index k = 0; k < body.mode_count(); ++k) {
    const ModeRecord& mode = body.modes[static_cast<std::size_t>(k)];
    if (mode.kind != kNormalMode) continue;
    normal.push_back(k);
    if (mode.name.find("bending") != std::string::npos) bending.push_back(k);
  }
  const auto first = [](const Indices& all, std::size_t count) {
    return Indices(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
  };
  std::vector<Choice> choices;
  for (const std::size_t count : {2U, 4U, 6U, 10U, 20U, 50U, 100U}) {
    if (count < normal.size()) choices.push_back({std::to_string(count), first(normal, count)});
    if (count == 4 && bending.size() >= 4) choices.push_back({"4 bending", first(bending, 4)});
  }
  if (!normal.empty()) choices.push_back({std::to_string(normal.size()), normal});
  return choices;
}

/// Modes at an interface to which a rigid body is attached.
struct LoadedInterface {
  Eigen::MatrixXd motions;      ///< C Phi of all modes, (6, m)
  Eigen::VectorXd eigenvalues;  ///< (m), 1/s^2
  StaticResponse response;
  Eigen::Matrix<double, 6, 6> mass;  ///< mass matrix of the rigid body
};

/// Lowest frequencies of K q = lambda (M + P^T M_rigid P) q.
Eigen::VectorXd loaded_frequencies(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass,
                                   const Eigen::MatrixXd& motions, const LoadedInterface& loaded) {
  const Eigen::MatrixXd whole = mass + motions.transpose() * loaded.mass * motions;
  const Eigen::VectorXd eigenvalues = symmetric_eigenvalues(stiffness, whole);
  const Eigen::Index count = std::min(kFrequencies, stiffness.rows());
  return eigenvalues.head(count).cwiseMax(0).cwiseSqrt() / (2 * std::numbers::pi);
}

ModeCountRow study(const Choice& choice, const LoadedInterface& loaded) {
  const Eigen::MatrixXd motions = loaded.motions(Eigen::all, choice.modes);
  const Eigen::VectorXd eigenvalues = loaded.eigenvalues(choice.modes);
  const Eigen::Index m = eigenvalues.size();
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(m, m);
  ModeCountRow row;
  row.kept = choice.label;
  row.modes_only_Hz = loaded_frequencies(eigenvalues.asDiagonal(), identity, motions, loaded);

  // Residual shapes X_r have a stiffness and a motion at the interface that are both F^T X_r.
  const Eigen::MatrixXd amplitudes =
      eigenvalues.cwiseInverse().asDiagonal() * motions.transpose();  // (m, 6)
  const Eigen::MatrixXd rest = loaded.response.compliance - motions * amplitudes;
  const Eigen::MatrixXd rest_mass = loaded.response.mass - amplitudes.transpose() * amplitudes;
  const Eigen::MatrixXd combinations =
      independent_loads(rest, loaded.response.compliance.diagonal()).combinations;
  const Eigen::Index n = m + combinations.cols();
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd mass = Eigen::MatrixXd::Identity(n, n);
  stiffness.topLeftCorner(m, m) = eigenvalues.asDiagonal();
  stiffness.bottomRightCorner(n - m, n - m) = combinations.transpose() * rest * combinations;
  mass.bottomRightCorner(n - m, n - m) = combinations.transpose() * rest_mass * combinations;
  Eigen::MatrixXd all_motions(6, n);
  all_motions << motions, rest * combinations;
  row.corrected_Hz = loaded_frequencies(stiffness, mass, all_motions, loaded);
  return row;
}

}  // namespace

std::vector<ModeCountRow> mode_count_study(const ModalBody& body,
                                           const AttachedFrequencies& attached) {
  const Interface& interface = body.interface(attached.interface);
  if (!attached.mass_matrix || !interface.response) return {};
  LoadedInterface loaded{Eigen::MatrixXd(6, body.mode_count()),
                         (2 * std::numbers::pi * body.frequencies_Hz).cwiseAbs2(),
                         *interface.response, *attached.mass_matrix};
  loaded.motions << interface.translation, interface.rotation;
  std::vector<ModeCountRow> rows;
  for (const Choice& choice : choices_of(body)) rows.push_back(study(choice, loaded));
  return rows;
}

}  // namespace flexneck::fe_modal
