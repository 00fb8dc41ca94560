// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/system/element_operator.h"

#include <optional>
#include <utility>

#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/dofs/point_element.h"
#include "fe_modal/element/element_fields.h"
#include "fe_modal/element/element_kernel.h"
#include "fe_modal/element/geometric_kernel.h"
#include "mesher/mesh/positions.h"

namespace flexneck::fe_modal {
namespace {

/// A row for each node, column a k + c: direction a of field c.
using NodalRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

NodalRows rows_of_nodes(const DofMap& dof_map, const Eigen::MatrixXd& columns) {
  const Eigen::Index k = columns.cols();
  NodalRows rows = NodalRows::Zero(dof_map.node_count(), 3 * k);
  for (std::int32_t node = 0; node < static_cast<std::int32_t>(rows.rows()); ++node) {
    const std::int32_t block = dof_map.index(node);
    if (dof_map.is_plain(node) && block < 0) continue;
    for (Eigen::Index c = 0; c < k; ++c) {
      const Eigen::Vector3d motion = dof_map.is_plain(node)
                                         ? Eigen::Vector3d(columns.col(c).segment<3>(3 * block))
                                         : dof_map.motion_of(node, columns.col(c));
      for (Eigen::Index a = 0; a < 3; ++a) rows(node, a * k + c) = motion[a];
    }
  }
  return rows;
}

/// The transpose of that.
Eigen::MatrixXd gathered(const DofMap& dof_map, const NodalRows& rows) {
  const Eigen::Index k = rows.cols() / 3;
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(dof_map.dof_count(), k);
  for (std::int32_t node = 0; node < static_cast<std::int32_t>(rows.rows()); ++node) {
    const std::int32_t block = dof_map.index(node);
    if (dof_map.is_plain(node) && block < 0) continue;
    for (Eigen::Index c = 0; c < k; ++c) {
      const Eigen::Vector3d force(rows(node, c), rows(node, k + c), rows(node, 2 * k + c));
      if (dof_map.is_plain(node)) {
        columns.col(c).segment<3>(3 * block) += force;
      } else {
        dof_map.add_force(node, force, columns.col(c));
      }
    }
  }
  return columns;
}

/// Degree of freedom a n + i of k fields, (3n, k), is row i and column a k + c of (n, 3k).
void add_product(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& fields,
                 Eigen::MatrixXd& result) {
  const Eigen::Index n = fields.rows();
  const Eigen::Index k = fields.cols() / 3;
  for (Eigen::Index a = 0; a < 3; ++a) {
    for (Eigen::Index b = 0; b < 3; ++b) {
      multiply(1, matrix.block(a * n, b * n, n, n), fields.middleCols(b * k, k), 1,
               result.middleCols(a * k, k));
    }
  }
}

/// Calls visit(nodes, kernel, material, geometric) for each element.
template <typename Visitor>
void visit_elements(const mesher::Mesh& mesh, const FormulationChoice& formulation,
                    bool is_prestressed, const Visitor& visit) {
  for (const mesher::ElementBlock& block : mesh.blocks) {
    const mesher::Material& material = mesh.materials.at(block.material);
    const ElementScheme& scheme = element_scheme(block.kind, formulation.of(material));
    ElementKernel kernel(scheme);
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
  NodalRows motions = rows_of_nodes(dof_map_, columns);
  NodalRows forces = NodalRows::Zero(motions.rows(), motions.cols());
  NodalRows momenta;
  if (with_mass) momenta.setZero(motions.rows(), motions.cols());
  Eigen::MatrixXd fields;
  Eigen::MatrixXd own_forces;
  Eigen::MatrixXd own_momenta;
  Eigen::MatrixXd displacements_m;
  Eigen::MatrixXd stress_stiffness;
  visit_elements(mesh_, formulation_, prestress_m_.cols() > 0,
                 [&](std::span<const std::int32_t> nodes, const Eigen::Matrix3Xd& coordinates,
                     const mesher::Material& material, ElementKernel& kernel,
                     std::optional<GeometricKernel>& geometric) {
                   const auto n = static_cast<Eigen::Index>(nodes.size());
                   fields.resize(n, motions.cols());
                   own_forces.resize(n, motions.cols());
                   own_momenta.resize(n, motions.cols());
                   for (Eigen::Index i = 0; i < n; ++i) {
                     fields.row(i) = motions.row(nodes[static_cast<std::size_t>(i)]);
                   }
                   kernel.apply(coordinates, material, fields, own_forces,
                                with_mass ? &own_momenta : nullptr);
                   if (geometric) {
                     gather(nodes, {&prestress_m_}, displacements_m);
                     stress_stiffness.setZero(3 * n, 3 * n);
                     geometric->add(coordinates, material, displacements_m, stress_stiffness);
                     add_product(stress_stiffness, fields, own_forces);
                   }
                   for (Eigen::Index i = 0; i < n; ++i) {
                     forces.row(nodes[static_cast<std::size_t>(i)]) += own_forces.row(i);
                     if (with_mass)
                       momenta.row(nodes[static_cast<std::size_t>(i)]) += own_momenta.row(i);
                   }
                 });
  Products products;
  // What is done with gives its memory to the next: these are as large as the vectors of a
  // solution.
  motions.resize(0, 0);
  products.forces = gathered(dof_map_, forces);
  forces.resize(0, 0);
  if (with_mass) products.momenta = gathered(dof_map_, momenta);
  for (const Point& point : points_) {
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
  return products;
}

void ElementOperator::for_each_stiffness(const Visitor& visit) const {
  Eigen::MatrixXd stiffness;
  Eigen::MatrixXd displacements_m;
  visit_elements(mesh_, formulation_, prestress_m_.cols() > 0,
                 [&](std::span<const std::int32_t> nodes, const Eigen::Matrix3Xd& coordinates,
                     const mesher::Material& material, ElementKernel& kernel,
                     std::optional<GeometricKernel>& geometric) {
                   kernel.find_stiffness(coordinates, material, stiffness);
                   if (geometric) {
                     gather(nodes, {&prestress_m_}, displacements_m);
                     geometric->add(coordinates, material, displacements_m, stiffness);
                   }
                   const ConstrainedElement constrained(nodes, dof_map_);
                   visit(constrained.numbers(), constrained.reduced(stiffness));
                 });
  for (const Point& point : points_) visit(point.element.numbers(), point.stiffness);
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
