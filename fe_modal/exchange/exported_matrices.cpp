// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/exchange/exported_matrices.h"

#include <cstdint>
#include <vector>

#include "fe_modal/system/assembly.h"
#include "mesher/mesh/positions.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kReading = "reading the system matrices";

/// Calls visit(row, column, value) for the entries of a matrix on one process, row by row.
template <typename Visit>
void each_entry(Mat matrix, const Visit& visit) {
  const auto size = static_cast<PetscInt>(size_of(matrix));
  for (PetscInt row = 0; row < size; ++row) {
    PetscInt count = 0;
    const PetscInt* columns = nullptr;
    const PetscScalar* values = nullptr;
    require(MatGetRow(matrix, row, &count, &columns, &values), kReading);
    for (PetscInt k = 0; k < count; ++k) visit(row, columns[k], values[k]);
    require(MatRestoreRow(matrix, row, &count, &columns, &values), kReading);
  }
}

UpperMatrix upper_of(Mat matrix) {
  require(MatGetRowUpperTriangular(matrix), kReading);
  std::vector<Eigen::Triplet<double, std::int32_t>> entries;
  each_entry(matrix, [&](PetscInt row, PetscInt column, double value) {
    if (column >= row) entries.emplace_back(row, column, value);
  });
  require(MatRestoreRowUpperTriangular(matrix), kReading);
  UpperMatrix upper(size_of(matrix), size_of(matrix));
  upper.setFromTriplets(entries.begin(), entries.end());
  return upper;
}

NodalMass nodal_of(Mat matrix) {
  std::vector<Eigen::Triplet<double, std::int32_t>> entries;
  each_entry(matrix, [&](PetscInt row, PetscInt column, double value) {
    entries.emplace_back(row, column, value);
  });
  NodalMass nodal(size_of(matrix), size_of(matrix));
  nodal.setFromTriplets(entries.begin(), entries.end());
  return nodal;
}

}  // namespace

ImportedBody export_matrices(const mesher::Mesh& mesh, const DofMap& dof_map,
                             const FormulationChoice& formulation) {
  const SystemMatrices system = assemble(mesh, dof_map, formulation);
  ImportedBody body{upper_of(system.stiffness.get()),
                    system.nodal.get() != nullptr ? expand_mass(nodal_of(system.nodal.get()))
                                                  : upper_of(system.mass.get()),
                    {}};
  body.nodes_m.resize(3, dof_map.free_count());
  const auto positions = mesher::positions_of(mesh);
  // The loop runs backwards, so that the position of the first of tied nodes remains.
  for (auto node = static_cast<std::int32_t>(dof_map.node_count()); node-- > 0;) {
    if (dof_map.index(node) < 0) continue;
    body.nodes_m.col(dof_map.index(node)) = positions.col(node);
  }
  return body;
}

}  // namespace flexneck::fe_modal
