// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/reduction/geometric_stiffness.h"

#include <array>

#include <Eigen/Geometry>

#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/body/skew.h"
#include "fe_modal/element/element_fields.h"
#include "fe_modal/reduction/static_response.h"
#include "mesher/mesh/positions.h"

namespace flexneck::fe_modal {
namespace {

/// Indices of a symmetric tensor's components: xx, yy, zz, xy, xz, yz.
constexpr std::array<std::array<std::size_t, 2>, 6> kPairs = {
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};

/// Sums int sigma : (grad psi_i^T grad psi_j) over elements as products of matrices: one row for
/// each pair i <= j of modes, one column for each stress field.
class StressIntegral {
 public:
  StressIntegral(Eigen::Index modes, Eigen::Index stresses)
      : modes_(modes), sums_(Eigen::MatrixXd::Zero(modes * (modes + 1) / 2, stresses)) {}

  /// @param fields fields of the modes, then the displacements that cause the stresses
  void add(const PointFields& fields, double shear_modulus_Pa) {
    const Eigen::Index points = fields.volumes_m3.size();
    products_.resize(sums_.rows(), 6 * points);
    stresses_.resize(sums_.cols(), 6 * points);
    for (Eigen::Index q = 0; q < points; ++q) {
      multiply_gradients(fields, q);
      find_stresses(fields, q, shear_modulus_Pa);
    }
    multiply_by_transpose(1, products_, stresses_, 1, sums_);
  }

  std::vector<Eigen::MatrixXd> matrices() const {
    std::vector<Eigen::MatrixXd> result;
    for (const auto& sums : sums_.colwise()) {
      Eigen::MatrixXd matrix(modes_, modes_);
      Eigen::Index row = 0;
      for (Eigen::Index i = 0; i < modes_; ++i) {
        for (Eigen::Index j = i; j < modes_; ++j) matrix(i, j) = matrix(j, i) = sums[row++];
      }
      result.push_back(std::move(matrix));
    }
    return result;
  }

 private:
  /// Finds the symmetric parts of sum_a psi_i,a,k psi_j,a,l, twice them off the diagonal, times the
  /// volume.
  void multiply_gradients(const PointFields& fields, Eigen::Index q) {
    for (std::size_t c = 0; c < kPairs.size(); ++c) {
      const auto [k, l] = kPairs[c];
      Eigen::Index row = 0;
      for (Eigen::Index i = 0; i < modes_; ++i) {
        for (Eigen::Index j = i; j < modes_; ++j) {
          double sum = 0;
          for (std::size_t a = 0; a < 3; ++a) {
            const Eigen::MatrixXd& along_k = fields.gradients[3 * a + k];
            const Eigen::MatrixXd& along_l = fields.gradients[3 * a + l];
            sum += along_k(i, q) * along_l(j, q);
            if (k != l) sum += along_l(i, q) * along_k(j, q);
          }
          products_(row++, 6 * q + static_cast<Eigen::Index>(c)) = fields.volumes_m3[q] * sum;
        }
      }
    }
  }

  void find_stresses(const PointFields& fields, Eigen::Index q, double shear_modulus_Pa) {
    for (std::size_t c = 0; c < kPairs.size(); ++c) {
      const auto [k, l] = kPairs[c];
      auto stress = stresses_.col(6 * q + static_cast<Eigen::Index>(c));
      const auto later = Eigen::seqN(modes_, stress.size());
      stress = shear_modulus_Pa *
               (fields.gradients[3 * k + l](later, q) + fields.gradients[3 * l + k](later, q));
      if (k == l) stress += fields.volumetric_Pa(later, q);
    }
  }

  Eigen::Index modes_;
  Eigen::MatrixXd sums_;      ///< (pairs of modes, stresses)
  Eigen::MatrixXd products_;  ///< workspace: (pairs of modes, 6 points)
  Eigen::MatrixXd stresses_;  ///< workspace: (stresses, 6 points)
};

/// Accelerations of the undeformed body: three for translations of the frame, three for rotations,
/// six for products of angular velocities.
std::vector<Eigen::Matrix3Xd> unit_accelerations(const Eigen::Matrix3Xd& positions) {
  std::vector<Eigen::Matrix3Xd> fields;
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  for (Eigen::Index i = 0; i < 3; ++i) fields.push_back(axes.col(i).replicate(1, positions.cols()));
  for (Eigen::Index i = 0; i < 3; ++i) fields.push_back(skew(axes.col(i)) * positions);
  for (const auto& [k, l] : kPairs) {
    const Eigen::Matrix3d one = skew(axes.col(static_cast<Eigen::Index>(k)));
    const Eigen::Matrix3d other = skew(axes.col(static_cast<Eigen::Index>(l)));
    const double share = k == l ? 0.5 : 1;
    fields.push_back(share * (one * other + other * one) * positions);
  }
  return fields;
}

/// Adds the inertia forces (negative mass times acceleration) of a particle in the same
/// accelerations, on all degrees of freedom.
void add_inertia_forces(const Particle& particle, const DofMap& dof_map, Eigen::MatrixXd& loads) {
  std::vector<Eigen::Matrix3Xd> accelerations = unit_accelerations(particle.position_m);
  for (const auto& motion : particle.motions.colwise()) accelerations.emplace_back(motion);
  for (std::size_t i = 0; i < accelerations.size(); ++i) {
    const Eigen::Vector3d force = -particle.mass_kg * accelerations[i];
    Eigen::VectorXd values = Eigen::VectorXd::Zero(loads.rows());
    dof_map.add_force(particle.site, force, values);
    if (particle.site >= dof_map.node_count()) {
      dof_map.add_force(particle.site + 1, particle.arm_m.cross(force), values);
    }
    loads.col(static_cast<Eigen::Index>(i)) += values;
  }
}

}  // namespace

std::vector<Eigen::MatrixXd> geometric_stiffness(
    const mesher::Mesh& mesh, const FormulationChoice& formulation,
    const std::vector<Eigen::Matrix3Xd>& modes,
    const std::vector<Eigen::Matrix3Xd>& displacements) {
  const auto m = static_cast<Eigen::Index>(modes.size());
  const auto k = static_cast<Eigen::Index>(displacements.size());
  StressIntegral integral(m, k);
  Displacements fields;
  for (const Eigen::Matrix3Xd& mode : modes) fields.push_back(&mode);
  for (const Eigen::Matrix3Xd& displacement : displacements) fields.push_back(&displacement);
  for_each_element(mesh, formulation, fields, [&](const ElementState& state) {
    integral.add(state.fields, state.shear_modulus_Pa);
  });
  return integral.matrices();
}

GeometricStiffness unit_load_stiffness(const mesher::Mesh& mesh,
                                       const FormulationChoice& formulation,
                                       const AssembledSystem& system, const BodyOperators& body,
                                       const std::vector<InterfaceLoads>& interfaces,
                                       const std::vector<Eigen::Matrix3Xd>& modes,
                                       const std::vector<Particle>& particles) {
  std::vector<Eigen::Matrix3Xd> accelerations = unit_accelerations(mesher::positions_of(mesh));
  accelerations.insert(accelerations.end(), modes.begin(), modes.end());
  const auto inertial = static_cast<Eigen::Index>(accelerations.size());
  Eigen::MatrixXd loads(system.fields().own_dof_count(),
                        inertial + static_cast<Eigen::Index>(6 * interfaces.size()));
  loads.leftCols(inertial) = -system.inertia_forces(accelerations);
  if (!particles.empty()) {
    const DofMap& dof_map = system.fields().dof_map();
    Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(dof_map.dof_count(), inertial);
    for (const Particle& particle : particles) add_inertia_forces(particle, dof_map, forces);
    loads.leftCols(inertial) += system.fields().layout().own_rows(forces);
  }
  for (std::size_t k = 0; k < interfaces.size(); ++k) {
    loads.middleCols<6>(inertial + static_cast<Eigen::Index>(6 * k)) = interfaces[k].forces;
  }
  const std::vector<Eigen::Matrix3Xd> displacements =
      system.fields().expand(static_response_beyond(body, {}, loads));
  const std::vector<Eigen::MatrixXd> all =
      geometric_stiffness(mesh, formulation, modes, displacements);
  const auto group = [&](std::size_t first, std::size_t count) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
    return std::vector<Eigen::MatrixXd>(begin, begin + static_cast<std::ptrdiff_t>(count));
  };
  GeometricStiffness stiffness{group(0, 3), group(3, 3), group(6, 6), group(12, modes.size()), {}};
  for (std::size_t k = 0; k < interfaces.size(); ++k) {
    stiffness.interfaces.push_back({interfaces[k].name, group(accelerations.size() + 6 * k, 3),
                                    group(accelerations.size() + 6 * k + 3, 3)});
  }
  return stiffness;
}

}  // namespace flexneck::fe_modal
