// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/system/element_operator.h"

#include <utility>

#include "fe_modal/dofs/point_element.h"
#include "fe_modal/element/element_fields.h"
#include "fe_modal/element/element_kernel.h"
#include "fe_modal/element/element_product.h"
#include "fe_modal/element/geometric_kernel.h"
#include "fe_modal/system/nodal_rows.h"
#include "mesher/mesh/positions.h"

namespace flexneck::fe_modal {
namespace {

/// Calls visit(nodes, coordinates, material, kernel, geometric) for each element.
template <typename Kernel, typename Visitor>
void visit_elements(const mesher::Mesh& mesh, const FormulationChoice& formulation,
                    bool is_prestressed, const Visitor& visit) {
  for (const mesher::ElementBlock& block : mesh.blocks) {
    const mesher::Material& material = mesh.materials.at(block.material);
    const ElementScheme& scheme = element_scheme(block.kind, formulation.of(material));
    Kernel kernel(scheme);
    std::optional<GeometricKernel> geometric;
    if (is_prestressed) geometric.emplace(scheme);
    const std::size_t width = mesher::nodes_per_element(block.kind);
    Eigen::Matrix3Xd coordinates(3, static_cast<Eigen::Index>(width));
    for (std::size_t first = 0; first < block.nodes.size(); first += width) {
      const auto nodes = std::span(block.nodes).subspan(first, width);
      mesher::copy_positions(mesh, nodes, coordinates);
      visit(nodes, std::as_const(coordinates), material, kernel, geometric);
    }
  }
}

}  // namespace

ElementOperator::ElementOperator(const mesher::Mesh& mesh, const DofMap& dof_map,
                                 const FormulationChoice& formulation, Eigen::Matrix3Xd prestress_m)
    : mesh_(mesh),
      dof_map_(dof_map),
      formulation_(formulation),
      prestress_m_(std::move(prestress_m)) {
  for (const PointElement& point : point_elements_of(mesh.connections, mesh.nodes.size())) {
    const ConstrainedElement element(point.sites, dof_map);
    points_.push_back({element, element.reduced(point.stiffness), element.reduced(point.mass)});
  }
}

ElementOperator::Products ElementOperator::multiply(const Eigen::MatrixXd& columns,
                                                    bool with_mass) const {
  const auto field_count = static_cast<std::size_t>(columns.cols());
  const auto node_count = static_cast<std::size_t>(dof_map_.node_count());
  // What is done with gives its memory to the next: each is as large as the vectors of a solution.
  std::optional<NodalRows> motions(std::in_place, dof_map_, columns);
  std::optional<NodalRows> forces(std::in_place, node_count, field_count);
  std::optional<NodalRows> momenta;
  if (with_mass) momenta.emplace(node_count, field_count);
  add_elements(*motions, *forces, momenta);
  motions.reset();
  Products products;
  products.forces = forces->gathered(dof_map_);
  forces.reset();
  if (with_mass) products.momenta = momenta->gathered(dof_map_);
  momenta.reset();
  for (const Point& point : points_) add_point(point, columns, with_mass, products);
  return products;
}

void ElementOperator::add_elements(const NodalRows& motions, NodalRows& forces,
                                   std::optional<NodalRows>& momenta) const {
  NodalRows fields(0, motions.field_count());
  NodalRows own_forces = fields;
  NodalRows own_momenta = fields;
  Eigen::MatrixXd displacements_m;
  Eigen::MatrixXd stress_stiffness;
  visit_elements<ElementProduct>(
      mesh_, formulation_, prestress_m_.cols() > 0,
      [&](std::span<const std::int32_t> nodes, const Eigen::Matrix3Xd& coordinates,
          const mesher::Material& material, ElementProduct& product,
          std::optional<GeometricKernel>& geometric) {
        for (NodalRows* const rows : {&fields, &own_forces, &own_momenta}) {
          rows->resize(nodes.size());
        }
        fields.take(motions, nodes);
        product.apply(coordinates, material, fields.data(), fields.field_count(), own_forces.data(),
                      momenta ? own_momenta.data() : nullptr);
        if (geometric) {
          gather(nodes, {&prestress_m_}, displacements_m);
          const auto size = static_cast<Eigen::Index>(3 * nodes.size());
          stress_stiffness.setZero(size, size);
          geometric->add(coordinates, material, displacements_m, stress_stiffness);
          own_forces.add_product(stress_stiffness, fields);
        }
        own_forces.add_to(forces, nodes);
        if (momenta) own_momenta.add_to(*momenta, nodes);
      });
}

void ElementOperator::add_point(const Point& point, const Eigen::MatrixXd& columns, bool with_mass,
                                Products& products) {
  const std::span<const std::int32_t> numbers = point.element.numbers();
  const auto m = static_cast<Eigen::Index>(numbers.size());
  Eigen::MatrixXd own = Eigen::MatrixXd::Zero(3 * m, columns.cols());
  const auto for_each_row = [&](const auto& action) {
    for (Eigen::Index i = 0; i < m; ++i) {
      const std::int32_t number = numbers[static_cast<std::size_t>(i)];
      for (Eigen::Index a = 0; number >= 0 && a < 3; ++a) action(a * m + i, 3 * number + a);
    }
  };
  for_each_row([&](Eigen::Index place, Eigen::Index row) { own.row(place) = columns.row(row); });
  const Eigen::MatrixXd own_force = point.stiffness * own;
  const Eigen::MatrixXd own_momentum = point.mass * own;
  for_each_row([&](Eigen::Index place, Eigen::Index row) {
    products.forces.row(row) += own_force.row(place);
    if (with_mass) products.momenta.row(row) += own_momentum.row(place);
  });
}

void ElementOperator::for_each_stiffness(const Visitor& visit) const {
  Eigen::MatrixXd stiffness;
  Eigen::MatrixXd displacements_m;
  visit_elements<ElementKernel>(
      mesh_, formulation_, prestress_m_.cols() > 0,
      [&](std::span<const std::int32_t> nodes, const Eigen::Matrix3Xd& coordinates,
          const mesher::Material& material, ElementKernel& kernel,
          std::optional<GeometricKernel>& geometric) {
        kernel.find_stiffness(coordinates, material, stiffness);
        if (geometric) {
          gather(nodes, {&prestress_m_}, displacements_m);
          geometric->add(coordinates, material, displacements_m, stiffness);
        }
        const ConstrainedElement constrained(nodes, dof_map_);
        stiffness = constrained.reduced(std::move(stiffness));
        visit(constrained.numbers(), stiffness);
      });
  for (const Point& point : points_) {
    stiffness = point.stiffness;
    visit(point.element.numbers(), stiffness);
  }
}

void ElementOperator::for_each_numbers(
    const std::function<void(std::span<const std::int32_t>)>& visit) const {
  for (const mesher::ElementBlock& block : mesh_.blocks) {
    const std::size_t width = mesher::nodes_per_element(block.kind);
    for (std::size_t first = 0; first < block.nodes.size(); first += width) {
      visit(ConstrainedElement(std::span(block.nodes).subspan(first, width), dof_map_).numbers());
    }
  }
  for (const Point& point : points_) visit(point.element.numbers());
}

}  // namespace flexneck::fe_modal
