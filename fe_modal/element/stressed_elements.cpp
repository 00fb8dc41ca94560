// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/element/stressed_elements.h"

#include "fe_modal/element/element_fields.h"

namespace flexneck::fe_modal {

Stresses stresses_of(const PointFields& fields, double shear_modulus_Pa, Eigen::Index field) {
  Stresses stresses(6, fields.volumes_m3.size());
  for (std::size_t c = 0; c < kStressAxes.size(); ++c) {
    const auto [k, l] = kStressAxes[c];
    auto row = stresses.row(static_cast<Eigen::Index>(c));
    row = shear_modulus_Pa *
          (fields.gradients[3 * k + l].row(field) + fields.gradients[3 * l + k].row(field));
    if (k == l) row += fields.volumetric_Pa.row(field);
  }
  return stresses;
}

void for_each_stressed_element(const mesher::Mesh& mesh, const FormulationChoice& formulation,
                               const Eigen::Matrix3Xd& displacements_m,
                               const std::function<void(const StressedElement&)>& visit) {
  ElementPoints points;
  ElementPoints mass_points;
  for_each_element(mesh, formulation, {&displacements_m}, [&](const ElementState& state) {
    state.kernel.locate(state.nodes_m, points, mass_points);
    visit({state.block, state.element, state.nodes, points,
           stresses_of(state.fields, state.shear_modulus_Pa, 0)});
  });
}

Eigen::Matrix3Xd internal_forces(const mesher::Mesh& mesh, const FormulationChoice& formulation,
                                 const Eigen::Matrix3Xd& displacements_m) {
  Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(mesh.nodes.size()));
  for_each_stressed_element(
      mesh, formulation, displacements_m, [&](const StressedElement& element) {
        const auto n = static_cast<Eigen::Index>(element.nodes.size());
        Eigen::MatrixX3d of_element = Eigen::MatrixX3d::Zero(n, 3);
        for (Eigen::Index q = 0; q < element.stress_Pa.cols(); ++q) {
          const Eigen::Map<const Eigen::MatrixX3d> gradients(element.points.gradients.col(q).data(),
                                                             n, 3);
          of_element +=
              gradients * (element.points.volumes_m3[q] * tensor_of(element.stress_Pa.col(q)));
        }
        for (Eigen::Index i = 0; i < n; ++i) {
          forces.col(element.nodes[static_cast<std::size_t>(i)]) += of_element.row(i).transpose();
        }
      });
  return forces;
}

}  // namespace flexneck::fe_modal
