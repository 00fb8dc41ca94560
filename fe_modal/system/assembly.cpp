// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/system/assembly.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "fe_modal/dofs/constrained_element.h"
#include "fe_modal/dofs/point_element.h"
#include "fe_modal/element/element_fields.h"
#include "fe_modal/element/element_kernel.h"
#include "fe_modal/element/geometric_kernel.h"
#include "geometry/foundation/error.h"
#include "mesher/mesh/positions.h"

namespace flexneck::fe_modal {
namespace {

/// An element's nodes by rising number, so that each row of a matrix is walked once.
class SortedNodes {
 public:
  struct Node {
    std::int32_t number;  ///< in the matrix; negative: it has no row
    Eigen::Index local;
  };

  template <typename Numbering>
  void assign(std::span<const std::int32_t> nodes, const Numbering& number) {
    sorted_.clear();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const std::int32_t row = number(nodes[i]);
      if (row >= 0) sorted_.push_back({row, static_cast<Eigen::Index>(i)});
    }
    std::sort(sorted_.begin(), sorted_.end(),
              [](const Node& one, const Node& other) { return one.number < other.number; });
  }

  std::span<const Node> all() const { return sorted_; }
  std::span<const Node> from(std::size_t k) const { return std::span(sorted_).subspan(k); }
  std::size_t size() const { return sorted_.size(); }

 private:
  std::vector<Node> sorted_;
};

/// Adds an element's stiffness, (3n, 3n) with degree of freedom a n + i.
void add_stiffness(const SortedNodes& nodes, const Eigen::MatrixXd& element,
                   SymmetricMatrix& stiffness) {
  const Eigen::Index n = element.rows() / 3;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const auto [row, i] = nodes.all()[k];
    const auto later = stiffness.later(row);
    auto place = later.begin();
    for (const auto& [column, j] : nodes.from(k)) {
      if (column == row) {
        // Itself, or a node that is tied to it, whose coupling comes from both sides.
        for (int a = 0; a < 3; ++a) {
          for (int b = a; b < 3; ++b) {
            double& entry = stiffness.entry(row, a, -1, b);
            entry += element(a * n + i, b * n + j);
            if (i != j) entry += element(a * n + j, b * n + i);
          }
        }
        continue;
      }
      place = std::lower_bound(place, later.end(), column);
      for (int a = 0; a < 3; ++a) {
        double* entries = &stiffness.entry(row, a, place - later.begin(), 0);
        for (int b = 0; b < 3; ++b) entries[b] += element(b * n + j, a * n + i);
      }
    }
  }
}

/// Adds an element's mass, (n, n).
void add_mass(const SortedNodes& nodes, const Eigen::MatrixXd& element, NodalMass& mass) {
  for (const auto& [row, i] : nodes.all()) {
    const std::int32_t* first = mass.innerIndexPtr() + mass.outerIndexPtr()[row];
    const std::int32_t* last = mass.innerIndexPtr() + mass.outerIndexPtr()[row + 1];
    const std::int32_t* place = first;
    for (const auto& [column, j] : nodes.all()) {
      place = std::lower_bound(place, last, column);
      mass.valuePtr()[mass.outerIndexPtr()[row] + (place - first)] += element(j, i);
    }
  }
}

/// The same where there are constraints, with which the mass is not the same in each direction.
void add_constrained(std::span<const std::int32_t> sites, const DofMap& dof_map,
                     const Eigen::MatrixXd& element_stiffness, const Eigen::MatrixXd& element_mass,
                     SymmetricMatrix& stiffness, SymmetricMatrix& mass) {
  const ConstrainedElement constrained(sites, dof_map);
  SortedNodes sorted;
  sorted.assign(constrained.numbers(), [](std::int32_t number) { return number; });
  add_stiffness(sorted, constrained.reduced(element_stiffness), stiffness);
  add_stiffness(sorted, constrained.reduced(element_mass), mass);
}

void add_block(const mesher::Mesh& mesh, const mesher::ElementBlock& block, const DofMap& dof_map,
               const FormulationChoice& formulation, const Eigen::Matrix3Xd& prestress_m,
               SymmetricMatrix& stiffness, NodalMass& mass,
               std::optional<SymmetricMatrix>& constrained_mass) {
  const mesher::Material& material = mesh.materials.at(block.material);
  const ElementScheme& scheme = element_scheme(block.kind, formulation.of(material));
  ElementKernel kernel(scheme);
  std::optional<GeometricKernel> geometric;
  if (prestress_m.cols() > 0) geometric.emplace(scheme);
  ElementMatrices element;
  Eigen::MatrixXd displacements_m;
  const std::size_t width = mesher::nodes_per_element(block.kind);
  Eigen::Matrix3Xd coordinates(3, static_cast<Eigen::Index>(width));
  SortedNodes sorted;
  for (std::size_t e = 0; e < block.size(); ++e) {
    const auto nodes = std::span(block.nodes).subspan(width * e, width);
    mesher::copy_positions(mesh, nodes, coordinates);
    try {
      kernel.compute(coordinates, material, element);
      if (geometric) {
        gather(nodes, {&prestress_m}, displacements_m);
        geometric->add(coordinates, material, displacements_m, element.stiffness);
      }
    } catch (const ComputationError& error) {
      throw ComputationError("part '" + block.part + "', element " + std::to_string(e) +
                             " of its " + std::string(mesher::name_of(block.kind)) + ": " +
                             error.what());
    }
    if (constrained_mass) {
      add_constrained(nodes, dof_map, element.stiffness, in_three_directions(element.mass),
                      stiffness, *constrained_mass);
    } else {
      sorted.assign(nodes, [&](std::int32_t node) { return dof_map.index(node); });
      add_stiffness(sorted, element.stiffness, stiffness);
    }
    sorted.assign(nodes, [](std::int32_t node) { return node; });
    add_mass(sorted, element.mass, mass);
  }
}

/// Each dependent degree of freedom gets the mean diagonal entry as its only stiffness, and no
/// mass.
void stiffen_dependent(const DofMap& dof_map, SymmetricMatrix& stiffness) {
  double sum = 0;
  const auto for_each = [&](const auto& action) {
    for (std::int32_t k = 0; k < static_cast<std::int32_t>(dof_map.free_count()); ++k) {
      for (int a = 0; a < 3; ++a) action(k, a, stiffness.entry(k, a, -1, a));
    }
  };
  for_each([&](std::int32_t /*k*/, int /*a*/, double entry) { sum += entry; });
  const double mean = sum / static_cast<double>(dof_map.dof_count());
  for_each([&](std::int32_t k, int a, double& entry) {
    if (dof_map.is_dependent(k, a)) entry = mean;
  });
}

}  // namespace

SystemMatrices assemble(const mesher::Mesh& mesh, const DofMap& dof_map,
                        const FormulationChoice& formulation, const Eigen::Matrix3Xd& prestress_m) {
  NodeGraph graph(mesh, dof_map);
  SymmetricMatrix stiffness(graph);
  NodalMass nodal_mass = zero_nodal_mass(NodeGraph(mesh));
  std::optional<SymmetricMatrix> constrained_mass;
  const std::vector<PointElement> points = point_elements_of(mesh.connections, mesh.nodes.size());
  if (dof_map.is_constrained() || !points.empty()) constrained_mass.emplace(graph);
  for (const mesher::ElementBlock& block : mesh.blocks) {
    add_block(mesh, block, dof_map, formulation, prestress_m, stiffness, nodal_mass,
              constrained_mass);
  }
  for (const PointElement& point : points) {
    add_constrained(point.sites, dof_map, point.stiffness, point.mass, stiffness,
                    *constrained_mass);
  }
  if (dof_map.dependent_count() > 0) stiffen_dependent(dof_map, stiffness);
  MassMatrix mass(nodal_mass, graph, dof_map);
  SystemMatrices system{std::move(graph), std::move(stiffness), NodalMass(), std::move(mass),
                        std::move(constrained_mass)};
  system.nodal_mass.swap(nodal_mass);  // this version of Eigen moves by copying
  return system;
}

SymmetricMatrix assemble_geometric(const mesher::Mesh& mesh, const DofMap& dof_map,
                                   const FormulationChoice& formulation,
                                   const Eigen::Matrix3Xd& prestress_m) {
  SymmetricMatrix result{NodeGraph(mesh, dof_map)};
  SortedNodes sorted;
  Eigen::MatrixXd displacements_m;
  for (const mesher::ElementBlock& block : mesh.blocks) {
    const mesher::Material& material = mesh.materials.at(block.material);
    GeometricKernel kernel(element_scheme(block.kind, formulation.of(material)));
    const std::size_t width = mesher::nodes_per_element(block.kind);
    Eigen::Matrix3Xd coordinates(3, static_cast<Eigen::Index>(width));
    Eigen::MatrixXd element(3 * coordinates.cols(), 3 * coordinates.cols());
    for (std::size_t e = 0; e < block.size(); ++e) {
      const auto nodes = std::span(block.nodes).subspan(width * e, width);
      mesher::copy_positions(mesh, nodes, coordinates);
      gather(nodes, {&prestress_m}, displacements_m);
      element.setZero();
      kernel.add(coordinates, material, displacements_m, element);
      if (dof_map.is_constrained()) {
        const ConstrainedElement constrained(nodes, dof_map);
        sorted.assign(constrained.numbers(), [](std::int32_t number) { return number; });
        add_stiffness(sorted, constrained.reduced(element), result);
      } else {
        sorted.assign(nodes, [&](std::int32_t node) { return dof_map.index(node); });
        add_stiffness(sorted, element, result);
      }
    }
  }
  return result;
}

SymmetricMatrix shifted_stiffness(const SystemMatrices& system, double shift) {
  SymmetricMatrix result = system.stiffness.clone();
  if (system.constrained_mass) {
    const auto mass = system.constrained_mass->values();
    for (std::size_t k = 0; k < mass.size(); ++k) result.values()[k] -= shift * mass[k];
    return result;
  }
  const NodalMass& mass = system.mass.between_nodes();
  for (std::int32_t node = 0; node < system.graph.node_count(); ++node) {
    std::ptrdiff_t place = -1;  // the diagonal block, then the later ones
    for (NodalMass::InnerIterator entry(mass, node); entry; ++entry) {
      if (entry.col() < node) continue;
      for (int a = 0; a < 3; ++a) result.entry(node, a, place, a) -= shift * entry.value();
      ++place;
    }
  }
  return result;
}

}  // namespace flexneck::fe_modal
