// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/assembled_system.h"

#include <Eigen/Cholesky>

#include "fe_modal/algebra/matrix_product.h"

namespace flexneck::fe_modal {

Eigen::MatrixXd AssembledSystem::rigid_modes() const {
  Eigen::MatrixXd modes = fields().layout().own_rows(
      model_.rigid().vectors(model_.mesh(), model_.connections(), model_.dof_map()));
  constexpr int kPasses = 2;  // the second pass removes the rounding of the first
  for (int pass = 0; pass < kPasses && modes.cols() > 0; ++pass) {
    const Eigen::MatrixXd gram = inner_products(ranks(), modes, block_product(mass(), modes));
    const Eigen::LLT<Eigen::MatrixXd> factor((gram + gram.transpose()) / 2);
    modes = factor.matrixU().solve<Eigen::OnTheRight>(modes).eval();
  }
  return modes;
}

Eigen::MatrixXd AssembledSystem::mass_integrals(const Eigen::MatrixXd& fields) const {
  Eigen::MatrixXd integrals = fields.transpose() * (matrices_.nodal_mass * fields);
  ranks().sum(integrals);
  return integrals;
}

Eigen::MatrixXd AssembledSystem::inertia_forces(
    std::span<const Eigen::Matrix3Xd> accelerations) const {
  const DofMap& dof_map = model_.dof_map();
  Eigen::MatrixXd forces(dof_map.dof_count(), static_cast<Eigen::Index>(accelerations.size()));
  for (Eigen::Index k = 0; k < forces.cols(); ++k) {
    const Eigen::MatrixXd nodal =
        matrices_.nodal_mass * accelerations[static_cast<std::size_t>(k)].transpose();
    forces.col(k) = dof_map.gather(nodal.transpose());
  }
  ranks().sum(forces);
  return fields().layout().own_rows(forces);
}

}  // namespace flexneck::fe_modal
