// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/analysis/coupling_gradient.h"

#include <algorithm>
#include <span>

#include <Eigen/Geometry>

#include "mesher/mesh/positions.h"

namespace flexneck::fe_modal {
namespace {

/// K u and M u of all fields at the nodes of a coupling, N and kg m; zero elsewhere.
struct NodalForces {
  std::vector<Eigen::Matrix3Xd> elastic;  ///< (3, n) for each field
  std::vector<Eigen::Matrix3Xd> inertial;
};

void add_element(std::span<const std::int32_t> nodes, const std::vector<bool>& is_coupled,
                 const ElementMatrices& element, const Eigen::MatrixXd& values,
                 NodalForces& forces) {
  const auto n = static_cast<Eigen::Index>(nodes.size());
  const Eigen::MatrixXd elastic = element.stiffness * values;
  for (std::size_t f = 0; f < forces.elastic.size(); ++f) {
    const auto column = static_cast<Eigen::Index>(f);
    for (Eigen::Index a = 0; a < 3; ++a) {
      const Eigen::VectorXd inertial = element.mass * values.col(column).segment(a * n, n);
      for (Eigen::Index i = 0; i < n; ++i) {
        const std::int32_t node = nodes[static_cast<std::size_t>(i)];
        if (!is_coupled[static_cast<std::size_t>(node)]) continue;
        forces.elastic[f](a, node) += elastic(a * n + i, column);
        forces.inertial[f](a, node) += inertial[i];
      }
    }
  }
}

/// Sums the forces of the elements that touch the coupling.
NodalForces forces_on(const std::vector<bool>& is_coupled, const mesher::Mesh& mesh,
                      const FormulationChoice& formulation, const Displacements& fields) {
  const Eigen::Matrix3Xd zero =
      Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(mesh.nodes.size()));
  NodalForces forces{std::vector(fields.size(), zero), std::vector(fields.size(), zero)};
  ElementMatrices element;
  Eigen::Matrix3Xd coordinates;
  Eigen::MatrixXd values;
  for (const mesher::ElementBlock& block : mesh.blocks) {
    const mesher::Material& material = mesh.materials.at(block.material);
    ElementKernel kernel(element_scheme(block.kind, formulation.of(material)));
    const std::size_t width = mesher::nodes_per_element(block.kind);
    for (std::size_t e = 0; e < block.size(); ++e) {
      const auto nodes = std::span(block.nodes).subspan(width * e, width);
      const bool touches = std::any_of(nodes.begin(), nodes.end(), [&](std::int32_t node) {
        return is_coupled[static_cast<std::size_t>(node)];
      });
      if (!touches) continue;
      mesher::copy_positions(mesh, nodes, coordinates);
      gather(nodes, fields, values);
      kernel.compute(coordinates, material, element);
      add_element(nodes, is_coupled, element, values, forces);
    }
  }
  return forces;
}

}  // namespace

void add_coupling_gradient(const mesher::Mesh& mesh, const FormulationChoice& formulation,
                           const std::vector<std::int32_t>& nodes,
                           const Eigen::Matrix3Xd& rotations, const Displacements& fields,
                           const std::vector<EnergyForm>& forms, BodyGradient& gradient) {
  std::vector<bool> is_coupled(mesh.nodes.size());
  for (const std::int32_t node : nodes) is_coupled[static_cast<std::size_t>(node)] = true;
  const NodalForces forces = forces_on(is_coupled, mesh, formulation, fields);
  const auto force = [&](Eigen::Index field, double lambda, std::int32_t node) -> Eigen::Vector3d {
    const auto place = static_cast<std::size_t>(field);
    return forces.elastic[place].col(node) - lambda * forces.inertial[place].col(node);
  };
  for (std::size_t k = 0; k < forms.size(); ++k) {
    const auto& [one, other, lambda] = forms[k];
    const Eigen::Vector3d of_one = rotations.col(one);
    const Eigen::Vector3d of_other = rotations.col(other);
    for (const std::int32_t node : nodes) {
      gradient.by_nodes[k].col(node) +=
          force(one, lambda, node).cross(of_other) + force(other, lambda, node).cross(of_one);
    }
  }
}

}  // namespace flexneck::fe_modal
