// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/modal_analysis.h"

namespace flexneck::fe_modal {

/// The processes that mpirun has started together, with PETSc ready on each. Rank 0 runs the
/// program; the others keep a share of the matrices and of the factor, and do nothing but what rank
/// 0 asks for. Only rank 0 reads, writes and prints, and what fails on another rank fails on rank
/// 0.
class Ranks {
 public:
  /// Whether mpirun has started more than one process; known without MPI.
  static bool are_many();

  Ranks();
  ~Ranks();  ///< rank 0 sends the others home
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int count() const { return count_; }
  bool is_leader() const { return rank_ == 0; }
  /// Of the other ranks: returns when rank 0 is done.
  void serve() const;

 private:
  PetscSession session_;
  int rank_ = 0;
  int count_ = 1;
};

}  // namespace flexneck::fe_modal
