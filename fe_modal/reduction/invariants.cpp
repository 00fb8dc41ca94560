// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/reduction/invariants.h"

namespace flexneck::fe_modal {
namespace {

/// Integrals c(a, b) = int rho p_a q_b of two vector fields.
using Products = Eigen::Matrix3d;

/// Cross integral int rho ~p q = int rho p x q.
Eigen::Vector3d cross_integral(const Products& c) {
  return {c(1, 2) - c(2, 1), c(2, 0) - c(0, 2), c(0, 1) - c(1, 0)};
}

/// Inertia integral -int rho ~p ~q = int rho (p.q I - q p^T).
Eigen::Matrix3d inertia_integral(const Products& c) {
  return c.trace() * Eigen::Matrix3d::Identity() - c.transpose();
}

}  // namespace

InertiaInvariants inertia_invariants(const NodalMass& mass,
                                     const std::vector<std::array<double, 3>>& nodes_m,
                                     const std::vector<Eigen::Matrix3Xd>& shapes) {
  return inertia_invariants(
      [&](const Eigen::MatrixXd& fields) -> Eigen::MatrixXd {
        return fields.transpose() * (mass * fields);
      },
      nodes_m, shapes);
}

InertiaInvariants inertia_invariants(const MassIntegrals& mass_integrals,
                                     const std::vector<std::array<double, 3>>& nodes_m,
                                     const std::vector<Eigen::Matrix3Xd>& shapes,
                                     const std::vector<Particle>& particles) {
  const auto n = static_cast<Eigen::Index>(nodes_m.size());
  const auto m = static_cast<Eigen::Index>(shapes.size());
  // Columns are 1, the components of s0, and those of psi_0 … psi_(m-1).
  Eigen::MatrixXd fields(n, 4 + 3 * m);
  fields.col(0).setOnes();
  for (Eigen::Index k = 0; k < n; ++k) {
    fields.row(k).segment<3>(1) =
        Eigen::Map<const Eigen::RowVector3d>(nodes_m[static_cast<std::size_t>(k)].data());
  }
  for (Eigen::Index l = 0; l < m; ++l) {
    fields.middleCols<3>(4 + 3 * l) = shapes[static_cast<std::size_t>(l)].transpose();
  }
  Eigen::MatrixXd integrals = mass_integrals(fields);
  for (const Particle& particle : particles) {
    Eigen::VectorXd values(4 + 3 * m);
    values << 1, particle.position_m, particle.motions.reshaped();
    integrals += particle.mass_kg * values * values.transpose();
  }
  const auto products = [&](Eigen::Index first, Eigen::Index second) -> Products {
    return integrals.block<3, 3>(1 + 3 * first, 1 + 3 * second);  // index 0: s0, l + 1: psi_l
  };

  InertiaInvariants result;
  result.mass = integrals(0, 0);
  result.S1 = integrals.block<3, 1>(1, 0);
  result.J0 = inertia_integral(products(0, 0));
  result.S2.resize(3, m);
  result.N0.resize(3, m);
  result.Maa.resize(m, m);
  for (Eigen::Index j = 0; j < m; ++j) {
    result.S2.col(j) = integrals.block<3, 1>(4 + 3 * j, 0);
    result.N0.col(j) = cross_integral(products(0, j + 1));
    result.G0.push_back(inertia_integral(products(0, j + 1)));
    for (Eigen::Index l = 0; l < m; ++l) {
      const Products c = products(j + 1, l + 1);
      result.G.push_back(inertia_integral(c));
      result.N.push_back(cross_integral(c));
      result.Maa(j, l) = c.trace();
    }
  }
  return result;
}

}  // namespace flexneck::fe_modal
