// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "fe_modal/algebra/petsc_handles.h"
#include "fe_modal/dofs/node_graph.h"

namespace flexneck::fe_modal {

/// Symmetric positive matrix of 3 x 3 blocks, one for each pair of neighbours of a graph. Of the
/// upper half each scalar row is stored in arrays of our own, which PETSc reads without a copy: to
/// put an element in its place takes a search for each pair of nodes, not for each of nine entries.
/// The columns of entries, which products do without, are made when somebody asks for them: of 8
/// bytes an entry 4 more. Not to be asked by several threads at once.
class SymmetricMatrix {
 public:
  /// Zero.
  explicit SymmetricMatrix(const NodeGraph& graph);

  SymmetricMatrix clone() const;

  PetscInt size() const { return static_cast<PetscInt>(arrays_->offsets.size()) - 1; }
  /// The matrix for PETSc. Changes of the entries show in it.
  Mat get() const;
  /// Frees what get() and columns() made; they make it again when they are called.
  void free_columns() const;
  /// Frees all; it has no rows from then on.
  void clear();

  /// The upper half by scalar rows: row i has columns()[offsets()[i]] … and their values.
  std::span<const PetscInt> offsets() const { return arrays_->offsets; }
  std::span<const PetscInt> columns() const;
  std::span<double> values() { return arrays_->values; }
  std::span<const double> values() const { return arrays_->values; }

  /// Columns to the right of the diagonal block in the rows of a node, ascending nodes.
  std::span<const std::int32_t> later(std::int32_t node) const;

  /// Entry (3 node + a, 3 other + b) with b >= a in the diagonal block (place = -1), or in that of
  /// later(node)[place].
  double& entry(std::int32_t node, int a, std::ptrdiff_t place, int b) {
    return arrays_->values[index(node, a, place, b)];
  }
  double entry(std::int32_t node, int a, std::ptrdiff_t place, int b) const {
    return arrays_->values[index(node, a, place, b)];
  }

 private:
  std::size_t index(std::int32_t node, int a, std::ptrdiff_t place, int b) const {
    const auto first = 3 * static_cast<std::size_t>(node) + static_cast<std::size_t>(a);
    const auto row = static_cast<std::size_t>(arrays_->offsets[first]);
    return row + static_cast<std::size_t>(3 * (place + 1) + b - a);
  }

  struct Arrays {
    std::vector<std::int32_t> node_offsets;
    std::vector<std::int32_t> later_nodes;
    std::vector<PetscInt> offsets;
    std::vector<PetscInt> columns;  ///< empty until asked for
    std::vector<PetscScalar> values;
  };

  static Arrays sparsity_of(const NodeGraph& graph);
  explicit SymmetricMatrix(Arrays arrays) : arrays_(std::make_unique<Arrays>(std::move(arrays))) {}

  std::unique_ptr<Arrays> arrays_;  ///< at a fixed address: the handle points into it
  mutable MatHandle handle_;
};

}  // namespace flexneck::fe_modal
