// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/analysis/attached_frequencies.h"

#include <algorithm>
#include <numbers>

#include "fe_modal/dofs/rigid_mass.h"
#include "fe_modal/solve/attached_mass.h"
#include "fe_modal/solve/eigensolver.h"

namespace flexneck::fe_modal {
namespace {

constexpr Eigen::Index kAttachedCount = 6;

}  // namespace

Eigen::VectorXd frequencies_Hz(const Eigen::VectorXd& eigenvalues) {
  return eigenvalues.cwiseMax(0).cwiseSqrt() / (2 * std::numbers::pi);
}

std::size_t interface_index(const ModalOptions& options, const std::string& name) {
  const auto found = std::find_if(options.interfaces.begin(), options.interfaces.end(),
                                  [&](const auto& interface) { return interface.name == name; });
  return static_cast<std::size_t>(found - options.interfaces.begin());
}

std::vector<AttachedFrequencies> attach_bodies(const SolvedBody& solved,
                                               std::vector<std::vector<Eigen::Matrix3Xd>>* shapes) {
  const ModalOptions& options = solved.system.model().options();
  const Eigen::Index count = std::min(kAttachedCount, size_of(solved.system.mass()));
  std::vector<AttachedFrequencies> result;
  for (const RigidAttachment& body : options.attachments) {
    const std::size_t region = interface_index(options, body.interface);
    const Matrix6d rigid_mass = rigid_mass_matrix(
        body.mass_kg, body.center_m - solved.averages[region].point_m(), body.inertia_kg_m2);
    const AttachedMass mass(solved.system.ranks(), solved.system.mass(),
                            solved.loads[region].forces, rigid_mass);
    Eigen::VectorXd values;
    if (shapes == nullptr) {
      values = lowest_eigenvalues(mass.matrix(), solved.inverse, count);
    } else {
      const EigenPairs pairs = lowest_eigenpairs(mass.matrix(), solved.inverse, count);
      shapes->push_back(solved.system.fields().expand(pairs.vectors));
      values = pairs.values;
    }
    result.push_back({body.name, body.interface, frequencies_Hz(values), rigid_mass});
  }
  return result;
}

}  // namespace flexneck::fe_modal
