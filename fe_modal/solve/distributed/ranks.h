// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "fe_modal/algebra/petsc_session.h"
#include "geometry/foundation/progress.h"

namespace flexneck::fe_modal {

/// The processes that mpirun has started together, with PETSc ready on each. Rank 0 runs the
/// program; the others keep a share of the matrices and of the factor, and do nothing but what rank
/// 0 asks for. Only rank 0 reads, writes and prints, and what fails on another rank fails on rank
/// 0. Where a rank fails in a way that the others cannot know of, it ends them all.
class Ranks {
 public:
  /// Whether mpirun has started more than one process; known without MPI.
  static bool are_many();

  /// @param last_words gets the line that says why all ranks are ended
  explicit Ranks(Progress last_words);
  ~Ranks();  ///< rank 0 sends the others home
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int count() const { return count_; }
  bool is_leader() const { return rank_ == 0; }
  /// Of the other ranks: returns when rank 0 is done.
  void serve() const;
  /// What the others take part in and wait for: only a ComputationError, which all ranks have then,
  /// leaves it. Anything else ends all ranks.
  void in_step(const std::function<void()>& work) const;

 private:
  /// In a handler: tells what was thrown.
  [[noreturn]] void end_all() const noexcept;

  PetscSession session_;
  Progress last_words_;
  int rank_ = 0;
  int count_ = 1;
};

}  // namespace flexneck::fe_modal
