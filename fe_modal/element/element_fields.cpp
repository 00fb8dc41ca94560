// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/element/element_fields.h"

#include "fe_modal/element/moduli.h"
#include "mesher/mesh/positions.h"

namespace flexneck::fe_modal {

void gather(std::span<const std::int32_t> nodes, const Displacements& fields,
            Eigen::MatrixXd& values) {
  const auto n = static_cast<Eigen::Index>(nodes.size());
  values.resize(3 * n, static_cast<Eigen::Index>(fields.size()));
  for (std::size_t f = 0; f < fields.size(); ++f) {
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index a = 0; a < 3; ++a) {
        values(a * n + i, static_cast<Eigen::Index>(f)) =
            (*fields[f])(a, nodes[static_cast<std::size_t>(i)]);
      }
    }
  }
}

void for_each_element(const mesher::Mesh& mesh, const FormulationChoice& formulation,
                      const Displacements& displacements,
                      const std::function<void(const ElementState&)>& visit) {
  PointFields fields;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const mesher::ElementBlock& block = mesh.blocks[b];
    const mesher::Material& material = mesh.materials.at(block.material);
    const double shear_modulus_Pa = moduli_of(material).mu;
    ElementKernel kernel(element_scheme(block.kind, formulation.of(material)));
    const std::size_t width = mesher::nodes_per_element(block.kind);
    Eigen::Matrix3Xd coordinates(3, static_cast<Eigen::Index>(width));
    Eigen::MatrixXd values;
    for (std::size_t e = 0; e < block.size(); ++e) {
      const auto nodes = std::span(block.nodes).subspan(width * e, width);
      mesher::copy_positions(mesh, nodes, coordinates);
      gather(nodes, displacements, values);
      kernel.evaluate(coordinates, material, values, fields);
      visit({b, e, nodes, coordinates, fields, shear_modulus_Pa, kernel});
    }
  }
}

}  // namespace flexneck::fe_modal
