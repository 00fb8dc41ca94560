// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/cholmod_handles.h"

#include <optional>
#include <string>

#include "fe_modal/algebra/cholesky_factor.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {

OutOfMemory no_memory_for_factor() {
  return out_of_memory("factorising the stiffness matrix", kOrAnotherSolution);
}

cholmod_sparse cholmod_view(std::span<const int> offsets, std::span<const int> columns,
                            std::span<const double> values) {
  // The upper half by rows is, to CHOLMOD, the lower half by columns.
  cholmod_sparse view{};
  view.nrow = view.ncol = offsets.size() - 1;
  view.nzmax = columns.size();
  view.p = const_cast<int*>(offsets.data());
  view.i = const_cast<int*>(columns.data());
  view.x = const_cast<double*>(values.data());
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = values.empty() ? CHOLMOD_PATTERN : CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

cholmod_sparse cholmod_view(Mat matrix) {
  constexpr const char* kReading = "reading the stiffness matrix";
  PetscInt size = 0;
  const PetscInt* offsets = nullptr;
  const PetscInt* columns = nullptr;
  PetscScalar* values = nullptr;
  PetscBool done = PETSC_FALSE;
  require(MatGetRowIJ(matrix, 0, PETSC_FALSE, PETSC_TRUE, &size, &offsets, &columns, &done),
          kReading);
  require(MatSeqSBAIJGetArray(matrix, &values), kReading);
  const auto rows = static_cast<std::size_t>(size);
  const auto entries = static_cast<std::size_t>(offsets[rows]);
  return cholmod_view({offsets, rows + 1}, {columns, entries}, {values, entries});
}

std::vector<int> in_threes(std::span<const int> numbers) {
  std::vector<int> dofs;
  dofs.reserve(3 * numbers.size());
  for (const int number : numbers) {
    for (int a = 0; a < 3; ++a) dofs.push_back(3 * number + a);
  }
  return dofs;
}

namespace {

/// Which blocks of three by three a matrix has.
struct BlockPattern {
  explicit BlockPattern(const cholmod_sparse& matrix);
  cholmod_sparse view() const { return cholmod_view(offsets, columns, {}); }

  std::vector<int> offsets = {0};
  std::vector<int> columns;
};

BlockPattern::BlockPattern(const cholmod_sparse& matrix) {
  const auto* const entry_offsets = static_cast<const int*>(matrix.p);
  const auto* const entries = static_cast<const int*>(matrix.i);
  for (std::size_t row = 0; row < matrix.ncol; row += 3) {
    for (int k = entry_offsets[row]; k < entry_offsets[row + 1]; k += 3) {
      columns.push_back(entries[k] / 3);
    }
    offsets.push_back(static_cast<int>(columns.size()));
  }
}

}  // namespace

CholmodAnalysis::CholmodAnalysis(const cholmod_sparse& matrix, CholmodOrder kind,
                                 std::span<const int> order)
    : matrix_(matrix) {
  cholmod_start(&common_);
  common_.print = 0;
  common_.supernodal = CHOLMOD_SUPERNODAL;
  std::optional<BlockPattern> blocks;
  if (kind != CholmodOrder::best && matrix.xtype != CHOLMOD_PATTERN) {
    blocks.emplace(matrix);
    block_size_ = 3;
    // Supernodes are joined as CHOLMOD joins those of entries: up to 4, 16 and 48 columns.
    common_.nrelax[0] = 1;
    common_.nrelax[1] = 5;
    common_.nrelax[2] = 16;
  }
  if (kind != CholmodOrder::best) {
    // Left to itself CHOLMOD also tries orders of its own and keeps the one it likes best.
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_GIVEN;
  }
  if (kind == CholmodOrder::numbering) {
    common_.method[0].ordering = CHOLMOD_NATURAL;
  }
  if (kind == CholmodOrder::numbering || kind == CholmodOrder::exactly) common_.postorder = 0;
  auto* const permutation = order.empty() ? nullptr : const_cast<int*>(order.data());
  cholmod_sparse analysed = blocks ? blocks->view() : matrix;
  factor_ = cholmod_analyze_p(&analysed, permutation, nullptr, 0, &common_);
  require_done();
  // Of a column of c blocks the three columns have 3c, 3c - 1 and 3c - 2 entries.
  nonzeros_ = blocks ? 9 * common_.lnz - 3.0 * static_cast<double>(analysed.ncol) : common_.lnz;
}

CholmodAnalysis::~CholmodAnalysis() {
  cholmod_free_sparse(&lower_half_, &common_);
  cholmod_free_factor(&factor_, &common_);
  cholmod_finish(&common_);
}

void CholmodAnalysis::require_done() const {
  if (common_.status == CHOLMOD_OUT_OF_MEMORY) throw no_memory_for_factor();
  if (common_.status == CHOLMOD_TOO_LARGE) {
    throw InputError(
        std::string("the factor of the stiffness matrix has more entries than CHOLMOD's "
                    "integers count; ") +
        kOrAnotherSolution);
  }
  if (common_.status < 0) {
    throw ComputationError("analysing the stiffness matrix failed: CHOLMOD's status " +
                           std::to_string(common_.status));
  }
}

LowerHalf CholmodAnalysis::lower_half() {
  const bool is_in_order = factor_->ordering == CHOLMOD_NATURAL;
  if (!is_in_order && lower_half_ == nullptr) {
    constexpr int kWithValues = 1;
    auto* const matrix = const_cast<cholmod_sparse*>(&matrix_);
    std::vector<int> order(static_cast<int*>(factor_->Perm),
                           static_cast<int*>(factor_->Perm) + factor_->n);
    if (block_size_ > 1) order = in_threes(order);
    auto* const permutation = order.data();
    cholmod_sparse* upper =
        cholmod_ptranspose(matrix, kWithValues, permutation, nullptr, 0, &common_);
    require_done();
    lower_half_ = cholmod_ptranspose(upper, kWithValues, nullptr, nullptr, 0, &common_);
    cholmod_free_sparse(&upper, &common_);
    require_done();
  }
  const cholmod_sparse& lower = is_in_order ? matrix_ : *lower_half_;
  const std::size_t columns = lower.ncol;
  const auto* const offsets = static_cast<const int*>(lower.p);
  const auto entries = static_cast<std::size_t>(offsets[columns]);
  return {{offsets, columns + 1},
          {static_cast<const int*>(lower.i), entries},
          {static_cast<const double*>(lower.x), entries}};
}

}  // namespace flexneck::fe_modal
