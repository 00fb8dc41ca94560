// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "fe_modal/algebra/petsc_session.h"
#include "fe_modal/algebra/ranks.h"
#include "geometry/foundation/progress.h"

namespace flexneck::fe_modal {

/// Outcome of a command on a rank.
struct RankOutcome {
  int exit_code = 0;
  std::string failure = {};  ///< message; empty if nothing has failed
};

/// PETSc on processes that mpirun or a batch system has started together.
class RankSession {
 public:
  /// True if mpirun or a batch system has started this process; determined without MPI.
  static bool is_launched();

  RankSession() : ranks_(Ranks::all()) {}

  const Ranks& ranks() const { return ranks_; }

  /// Synchronises all ranks at the end. If ranks have failed, the first of them reports. If others
  /// do not come, since they wait for a rank that has failed alone, that rank reports and ends all
  /// of them.
  /// @param tell receives the message
  /// @return the exit code, the same on all ranks
  int end(const RankOutcome& outcome, const Progress& tell) const;

 private:
  PetscSession session_;
  Ranks ranks_;
};

}  // namespace flexneck::fe_modal
