// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cholmod.h>
#include <cstdint>
#include <span>
#include <vector>

#include "fe_modal/algebra/cholmod_order.h"
#include "fe_modal/algebra/petsc_handles.h"
#include "fe_modal/algebra/supernodal_elimination.h"
#include "geometry/foundation/available_memory.h"

namespace flexneck::fe_modal {

/// What to do about a factor that is too large.
inline constexpr const char* kOrAnotherSolution =
    "take a coarser mesh, --solver iterative, or more ranks with mpirun";
/// Where memory runs out.
OutOfMemory no_memory_for_factor();

/// A symmetric matrix whose upper half by rows is stored, columns ascending; it is only read.
/// Without values: the places of entries alone, both halves.
cholmod_sparse cholmod_view(std::span<const int> offsets, std::span<const int> columns,
                            std::span<const double> values);

/// Of a matrix in PETSc's arrays, which must outlive it.
cholmod_sparse cholmod_view(Mat matrix);

/// Each number as those of its three degrees of freedom.
std::vector<int> in_threes(std::span<const int> numbers);

/// The places of the entries of a matrix's supernodal factor. Unless CHOLMOD seeks the best order
/// it sees blocks of three by three, with a ninth of the entries.
class CholmodAnalysis {
 public:
  /// @param matrix must outlive this; with values, unless the best order is sought, of whole blocks
  /// @param order of elimination if it is given, a permutation of the blocks
  /// @throws InputError if CHOLMOD's integers do not count the entries, OutOfMemory.
  CholmodAnalysis(const cholmod_sparse& matrix, CholmodOrder kind, std::span<const int> order = {});
  ~CholmodAnalysis();
  CholmodAnalysis(const CholmodAnalysis&) = delete;
  CholmodAnalysis& operator=(const CholmodAnalysis&) = delete;

  /// Of the entries, or of blocks of so many rows and columns.
  const cholmod_factor& places() const { return *factor_; }
  int block_size() const { return block_size_; }
  /// Of the factor, without the zeros in its supernodes.
  double nonzeros() const { return nonzeros_; }
  /// Of the matrix in the order of elimination; lives as long as this.
  /// @throws OutOfMemory
  LowerHalf lower_half();

 private:
  void require_done() const;

  const cholmod_sparse& matrix_;
  int block_size_ = 1;
  cholmod_common common_{};
  double nonzeros_ = 0;
  cholmod_factor* factor_ = nullptr;
  cholmod_sparse* lower_half_ = nullptr;
};

}  // namespace flexneck::fe_modal
