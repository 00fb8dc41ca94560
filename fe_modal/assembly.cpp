// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/assembly.h"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <vector>

#include "fe_modal/node_graph.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kAssembling = "assembling the system matrices";

/// Zero symmetric matrix with room for exactly the upper half of what couples free nodes.
/// @param each_direction_alone directions do not couple, as in the mass
MatHandle make_matrix(const NodeGraph& graph, const FreeNodes& free_nodes,
                      bool each_direction_alone) {
  std::vector<PetscInt> row_counts;
  row_counts.reserve(static_cast<std::size_t>(free_nodes.dof_count()));
  for (std::int32_t node = 0; node < graph.node_count(); ++node) {
    const std::int32_t index = free_nodes.index(node);
    if (index < 0) continue;
    const auto neighbours = graph.neighbours(node);
    const auto later = static_cast<PetscInt>(
        std::count_if(neighbours.begin(), neighbours.end(),
                      [&](std::int32_t other) { return free_nodes.index(other) > index; }));
    for (PetscInt a = 0; a < 3; ++a) {
      row_counts.push_back(each_direction_alone ? later + 1 : 3 * later + 3 - a);
    }
  }
  const auto size = static_cast<PetscInt>(free_nodes.dof_count());
  MatHandle matrix;
  require(MatCreateSeqSBAIJ(PETSC_COMM_SELF, 1, size, size, 0, row_counts.data(), matrix.out()),
          kAssembling);
  require(MatSetOption(matrix.get(), MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_TRUE), kAssembling);
  require(MatSetOption(matrix.get(), MAT_IGNORE_LOWER_TRIANGULAR, PETSC_TRUE), kAssembling);
  require(MatSetOption(matrix.get(), MAT_SPD, PETSC_TRUE), kAssembling);
  return matrix;
}

void finish(const MatHandle& matrix) {
  require(MatAssemblyBegin(matrix.get(), MAT_FINAL_ASSEMBLY), kAssembling);
  require(MatAssemblyEnd(matrix.get(), MAT_FINAL_ASSEMBLY), kAssembling);
}

NodalMass zero_mass(const NodeGraph& graph) {
  const auto n = static_cast<Eigen::Index>(graph.node_count());
  const std::vector<double> zeros(graph.columns().size(), 0.0);
  return Eigen::Map<const NodalMass>(n, n, static_cast<Eigen::Index>(zeros.size()),
                                     graph.offsets().data(), graph.columns().data(), zeros.data());
}

/// The nodal mass in each of the three directions, between free nodes.
MatHandle expand_mass(const NodalMass& nodal_mass, const NodeGraph& graph,
                      const FreeNodes& free_nodes) {
  MatHandle mass = make_matrix(graph, free_nodes, true);
  std::vector<PetscInt> columns;
  std::vector<PetscScalar> values;
  for (std::int32_t node = 0; node < graph.node_count(); ++node) {
    if (free_nodes.index(node) < 0) continue;
    columns.clear();
    values.clear();
    for (NodalMass::InnerIterator entry(nodal_mass, node); entry; ++entry) {
      const std::int32_t column = free_nodes.index(static_cast<std::int32_t>(entry.col()));
      if (column < 0) continue;
      columns.push_back(3 * column);
      values.push_back(entry.value());
    }
    for (PetscInt a = 0; a < 3; ++a) {
      const PetscInt row = 3 * free_nodes.index(node) + a;
      require(MatSetValues(mass.get(), 1, &row, static_cast<PetscInt>(columns.size()),
                           columns.data(), values.data(), INSERT_VALUES),
              kAssembling);
      for (PetscInt& column : columns) ++column;
    }
  }
  finish(mass);
  return mass;
}

void add_block(const mesher::Mesh& mesh, const mesher::ElementBlock& block,
               const FreeNodes& free_nodes, const Hex27Kernel& kernel, Formulation formulation,
               ElementMatrices& element, SystemMatrices& system) {
  const mesher::Material& material = mesh.materials.at(block.material);
  Hex27Coordinates coordinates;
  std::array<PetscInt, 81> dofs{};
  for (std::size_t e = 0; e < block.size(); ++e) {
    const std::int32_t* nodes = block.nodes.data() + 27 * e;
    for (int i = 0; i < 27; ++i) {
      coordinates.col(i) =
          Eigen::Map<const Eigen::Vector3d>(mesh.nodes[static_cast<std::size_t>(nodes[i])].data());
      const std::int32_t index = free_nodes.index(nodes[i]);
      for (std::int32_t a = 0; a < 3; ++a) {
        // PETSc leaves out rows and columns with a negative index.
        dofs[static_cast<std::size_t>(3 * i + a)] = index < 0 ? -1 : 3 * index + a;
      }
    }
    kernel.compute(coordinates, material, formulation, element);
    require(MatSetValues(system.stiffness.get(), 81, dofs.data(), 81, dofs.data(),
                         element.stiffness.data(), ADD_VALUES),
            kAssembling);
    for (int i = 0; i < 27; ++i) {
      for (int j = 0; j < 27; ++j) {
        system.nodal_mass.coeffRef(nodes[i], nodes[j]) += element.mass(i, j);
      }
    }
  }
}

}  // namespace

SystemMatrices assemble(const mesher::Mesh& mesh, const FreeNodes& free_nodes,
                        Formulation formulation) {
  const NodeGraph graph(mesh);
  SystemMatrices system;
  system.stiffness = make_matrix(graph, free_nodes, false);
  system.nodal_mass = zero_mass(graph);
  const Hex27Kernel kernel;
  const auto element = std::make_unique<ElementMatrices>();  // 58 kB: too much for the stack
  for (const mesher::ElementBlock& block : mesh.blocks) {
    add_block(mesh, block, free_nodes, kernel, formulation, *element, system);
  }
  finish(system.stiffness);
  system.mass = expand_mass(system.nodal_mass, graph, free_nodes);
  return system;
}

}  // namespace flexneck::fe_modal
