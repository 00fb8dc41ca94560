// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/mass_matrix.h"

#include <algorithm>
#include <vector>

namespace flexneck::fe_modal {
namespace {

constexpr const char* kMaking = "making the mass matrix";

NodalMass restrict_to_free(const NodalMass& all_nodes, const NodeGraph& graph,
                           const FreeNodes& free_nodes) {
  NodalMass result = zero_nodal_mass(graph);
  for (std::int32_t node = 0; node < free_nodes.node_count(); ++node) {
    const std::int32_t row = free_nodes.index(node);
    if (row < 0) continue;
    const auto columns = graph.neighbours(row);
    double* values = result.valuePtr() + result.outerIndexPtr()[row];
    auto place = columns.begin();
    for (NodalMass::InnerIterator entry(all_nodes, node); entry; ++entry) {
      const std::int32_t column = free_nodes.index(static_cast<std::int32_t>(entry.col()));
      if (column < 0) continue;
      // Columns ascend, unless nodes are tied.
      if (place == columns.end() || column < *place) place = columns.begin();
      place = std::lower_bound(place, columns.end(), column);
      values[place - columns.begin()] += entry.value();
    }
  }
  return result;
}

/// y = M x, three directions at once.
PetscErrorCode multiply(Mat shell, Vec x, Vec y) {
  const NodalMass* mass = nullptr;
  PetscErrorCode code = MatShellGetContext(shell, static_cast<void*>(&mass));
  const PetscScalar* in = nullptr;
  PetscScalar* out = nullptr;
  if (code == 0) code = VecGetArrayRead(x, &in);
  if (code == 0) code = VecGetArray(y, &out);
  if (code != 0) return code;
  const std::int32_t* columns = mass->innerIndexPtr();
  const double* values = mass->valuePtr();
  for (Eigen::Index row = 0; row < mass->rows(); ++row) {
    double sum[3] = {0, 0, 0};
    for (std::int32_t k = mass->outerIndexPtr()[row]; k < mass->outerIndexPtr()[row + 1]; ++k) {
      const double* velocity = in + 3 * static_cast<std::ptrdiff_t>(columns[k]);
      for (int a = 0; a < 3; ++a) sum[a] += values[k] * velocity[a];
    }
    std::copy_n(sum, 3, out + 3 * row);
  }
  code = VecRestoreArray(y, &out);
  return code != 0 ? code : VecRestoreArrayRead(x, &in);
}

}  // namespace

NodalMass zero_nodal_mass(const NodeGraph& graph) {
  const auto n = static_cast<Eigen::Index>(graph.node_count());
  const std::vector<double> zeros(graph.columns().size(), 0.0);
  return Eigen::Map<const NodalMass>(n, n, static_cast<Eigen::Index>(zeros.size()),
                                     graph.offsets().data(), graph.columns().data(), zeros.data());
}

MassMatrix::MassMatrix(const NodalMass& all_nodes, const NodeGraph& graph,
                       const FreeNodes& free_nodes)
    : nodal_(std::make_unique<const NodalMass>(restrict_to_free(all_nodes, graph, free_nodes))) {
  const auto size = static_cast<PetscInt>(free_nodes.dof_count());
  // PETSc hands the context back as it is; the mass is not changed through it.
  require(MatCreateShell(PETSC_COMM_SELF, size, size, size, size,
                         const_cast<NodalMass*>(nodal_.get()), shell_.out()),
          kMaking);
  require(MatShellSetOperation(shell_.get(), MATOP_MULT, reinterpret_cast<void (*)()>(&multiply)),
          kMaking);
  require(MatSetOption(shell_.get(), MAT_SYMMETRIC, PETSC_TRUE), kMaking);
}

}  // namespace flexneck::fe_modal
