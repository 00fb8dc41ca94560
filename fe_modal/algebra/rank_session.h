// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "fe_modal/algebra/petsc_session.h"
#include "fe_modal/algebra/ranks.h"
#include "geometry/foundation/progress.h"

namespace flexneck::fe_modal {

/// How a command has ended on a rank.
struct RankOutcome {
  int exit_code = 0;
  std::string failure = {};  ///< what to tell; empty: nothing has failed
};

/// PETSc on processes that mpirun or a batch system has started together.
class RankSession {
 public:
  /// Whether this process was started so; known without MPI.
  static bool is_launched();

  RankSession() : ranks_(Ranks::all()) {}

  const Ranks& ranks() const { return ranks_; }

  /// All ranks meet here at the end. Where ranks have failed, the first of these tells. If others
  /// do not come, since they wait for one that has failed alone, that one tells and ends all.
  /// @param tell gets the line
  /// @return the exit code, the same on all ranks
  int end(const RankOutcome& outcome, const Progress& tell) const;

 private:
  PetscSession session_;
  Ranks ranks_;
};

}  // namespace flexneck::fe_modal
