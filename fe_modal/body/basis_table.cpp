// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/body/basis_table.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace flexneck::fe_modal {
namespace {

/// Cumulative sums down each column, in per cent of the totals.
Eigen::MatrixXd cumulative_percent(Eigen::MatrixXd parts, const Eigen::RowVectorXd& wholes) {
  for (Eigen::Index k = 1; k < parts.rows(); ++k) parts.row(k) += parts.row(k - 1);
  return 100 * (parts.array().rowwise() / wholes.array()).matrix();
}

/// Squares of the interface's motions in each mode over the mode's eigenvalue; zero for rigid
/// motions.
Eigen::MatrixXd modal_compliances(const ModalBody& body, const Interface& interface) {
  Eigen::MatrixXd parts(body.mode_count(), 6);
  parts << interface.translation.transpose(), interface.rotation.transpose();
  for (Eigen::Index k = 0; k < parts.rows(); ++k) {
    const double omega = 2 * std::numbers::pi * body.frequencies_Hz[k];
    parts.row(k) =
        omega > 0 ? (parts.row(k) / omega).cwiseAbs2().eval() : Eigen::RowVectorXd::Zero(6).eval();
  }
  return parts;
}

}  // namespace

BasisTable basis_table(const ModalBody& body) {
  const InertiaInvariants& inertia = body.invariants;
  BasisTable table;
  table.effective_mass_kg = inertia.S2.transpose().cwiseAbs2();
  table.effective_inertia_kg_m2 = inertia.N0.transpose().cwiseAbs2();
  Eigen::MatrixXd parts(body.mode_count(), 6);
  parts << table.effective_mass_kg, table.effective_inertia_kg_m2;
  Eigen::RowVectorXd wholes(6);
  wholes << Eigen::RowVector3d::Constant(inertia.mass), inertia.J0.diagonal().transpose();
  table.inertia_percent = cumulative_percent(parts, wholes);
  for (const Interface& interface : body.interfaces) {
    if (!interface.response) continue;
    table.compliance.push_back(
        {interface.name,
         cumulative_percent(modal_compliances(body, interface),
                            interface.response->compliance.diagonal().transpose())});
  }
  return table;
}

bool has_shares(const ModalBody& body) {
  return std::any_of(body.modes.begin(), body.modes.end(), [](const ModeRecord& mode) {
    return mode.shares_percent != std::array<double, 4>{};
  });
}

}  // namespace flexneck::fe_modal
