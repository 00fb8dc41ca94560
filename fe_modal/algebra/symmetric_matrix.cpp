// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/symmetric_matrix.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kMaking = "making the system matrices";

}  // namespace

SymmetricMatrix::Arrays SymmetricMatrix::sparsity_of(const NodeGraph& graph) {
  const std::size_t entries =
      9 * (graph.columns().size() / 2 + 1) + 3 * static_cast<std::size_t>(graph.node_count());
  if (entries > static_cast<std::size_t>(std::numeric_limits<PetscInt>::max())) {
    throw InputError("the stiffness has " + std::to_string(entries) +
                     " entries, more than PETSc's integers count; take a coarser mesh");
  }
  Arrays arrays;
  arrays.node_offsets.push_back(0);
  arrays.offsets.push_back(0);
  for (std::int32_t node = 0; node < graph.node_count(); ++node) {
    const auto neighbours = graph.neighbours(node);
    const auto later = neighbours.subspan(static_cast<std::size_t>(
        std::upper_bound(neighbours.begin(), neighbours.end(), node) - neighbours.begin()));
    arrays.later_nodes.insert(arrays.later_nodes.end(), later.begin(), later.end());
    arrays.node_offsets.push_back(static_cast<std::int32_t>(arrays.later_nodes.size()));
    for (PetscInt a = 0; a < 3; ++a) {
      const auto entries_of_row = static_cast<PetscInt>(3 * later.size()) + 3 - a;
      arrays.offsets.push_back(arrays.offsets.back() + entries_of_row);
    }
  }
  arrays.values.assign(static_cast<std::size_t>(arrays.offsets.back()), 0);
  return arrays;
}

SymmetricMatrix::SymmetricMatrix(const NodeGraph& graph) : SymmetricMatrix(sparsity_of(graph)) {}

std::span<const PetscInt> SymmetricMatrix::columns() const {
  std::vector<PetscInt>& columns = arrays_->columns;
  if (!columns.empty()) return columns;
  columns.reserve(arrays_->values.size());
  for (PetscInt node = 0; 3 * node < size(); ++node) {
    for (PetscInt a = 0; a < 3; ++a) {
      for (PetscInt b = a; b < 3; ++b) columns.push_back(3 * node + b);
      for (const std::int32_t other : later(node)) {
        for (PetscInt b = 0; b < 3; ++b) columns.push_back(3 * other + b);
      }
    }
  }
  return columns;
}

Mat SymmetricMatrix::get() const {
  if (handle_.get() != nullptr) return handle_.get();
  columns();
  require(
      MatCreateSeqSBAIJWithArrays(PETSC_COMM_SELF, 1, size(), size(), arrays_->offsets.data(),
                                  arrays_->columns.data(), arrays_->values.data(), handle_.out()),
      kMaking);
  require(MatSetOption(handle_.get(), MAT_SPD, PETSC_TRUE), kMaking);
  return handle_.get();
}

void SymmetricMatrix::free_columns() const {
  handle_ = MatHandle();
  std::vector<PetscInt>().swap(arrays_->columns);
}

void SymmetricMatrix::clear() {
  handle_ = MatHandle();
  arrays_ = std::make_unique<Arrays>(Arrays{{}, {}, {0}, {}, {}});
}

SymmetricMatrix SymmetricMatrix::clone() const { return SymmetricMatrix(Arrays(*arrays_)); }

std::span<const std::int32_t> SymmetricMatrix::later(std::int32_t node) const {
  const auto row = static_cast<std::size_t>(node);
  const auto begin = static_cast<std::size_t>(arrays_->node_offsets[row]);
  const auto end = static_cast<std::size_t>(arrays_->node_offsets[row + 1]);
  return std::span(arrays_->later_nodes).subspan(begin, end - begin);
}

}  // namespace flexneck::fe_modal
