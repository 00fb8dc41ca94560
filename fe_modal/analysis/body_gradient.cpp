// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/analysis/body_gradient.h"

#include <span>

#include "mesher/mesh/positions.h"

namespace flexneck::fe_modal {
namespace {

void add_element(std::span<const std::int32_t> nodes, std::size_t material,
                 const ElementGradient& element, BodyGradient& body) {
  const auto forms = static_cast<Eigen::Index>(body.by_nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    body.mass_by_nodes.col(nodes[i]) += element.mass_by_nodes.col(column);
    for (Eigen::Index k = 0; k < forms; ++k) {
      auto place = body.by_nodes[static_cast<std::size_t>(k)].col(nodes[i]);
      for (Eigen::Index a = 0; a < 3; ++a) place[a] += element.by_nodes(a * forms + k, column);
    }
  }
  body.by_material[material] += element.by_material;
  body.volumes_m3[static_cast<Eigen::Index>(material)] += element.volume_m3;
}

}  // namespace

BodyGradient body_gradient(const mesher::Mesh& mesh, const FormulationChoice& formulation,
                           const Displacements& fields, const std::vector<EnergyForm>& forms) {
  const auto n = static_cast<Eigen::Index>(mesh.nodes.size());
  const auto f = static_cast<Eigen::Index>(forms.size());
  BodyGradient body{
      std::vector(forms.size(), Eigen::Matrix3Xd(Eigen::Matrix3Xd::Zero(3, n))),
      std::vector(mesh.materials.size(), Eigen::MatrixX3d(Eigen::MatrixX3d::Zero(f, 3))),
      Eigen::Matrix3Xd::Zero(3, n),
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(mesh.materials.size()))};
  ElementGradient element;
  Eigen::Matrix3Xd coordinates;
  Eigen::MatrixXd values;
  for (const mesher::ElementBlock& block : mesh.blocks) {
    const mesher::Material& material = mesh.materials.at(block.material);
    EnergyGradient gradient(element_scheme(block.kind, formulation.of(material)), forms);
    const std::size_t width = mesher::nodes_per_element(block.kind);
    for (std::size_t e = 0; e < block.size(); ++e) {
      const auto nodes = std::span(block.nodes).subspan(width * e, width);
      mesher::copy_positions(mesh, nodes, coordinates);
      gather(nodes, fields, values);
      gradient.compute(coordinates, material, values, element);
      add_element(nodes, block.material, element, body);
    }
  }
  return body;
}

}  // namespace flexneck::fe_modal
