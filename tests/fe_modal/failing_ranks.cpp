// SPDX-License-Identifier: GPL-3.0-or-later
// Fails as a library or a rank may fail, for tests of the remaining state:
//   failing_ranks start   PETSc starts, and the next call of the session fails
//   failing_ranks rank    under mpirun: rank 0 ends for lack of memory, the others wait for it in a
//   sum
#include <cstdio>
#include <string>
#include <string_view>

#include <slepceps.h>

#include "fe_modal/algebra/petsc_session.h"
#include "fe_modal/algebra/rank_session.h"
#include "geometry/foundation/error.h"

namespace {

bool session_fails = false;

int fail_at_start() {
  session_fails = true;
  try {
    const flexneck::fe_modal::PetscSession session;
  } catch (const flexneck::ComputationError&) {
    int is_finalised = 0;
    MPI_Finalized(&is_finalised);
    std::puts(is_finalised != 0 ? "finalised" : "left running");
    return 0;
  }
  std::puts("started");
  return 0;
}

int fail_on_a_rank() {
  const flexneck::fe_modal::RankSession session;
  flexneck::fe_modal::RankOutcome outcome;
  if (session.ranks().is_first()) {
    outcome = {3, "out of memory"};
  } else {
    session.ranks().sum(1.0);
  }
  return session.end(outcome,
                     [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); });
}

}  // namespace

// Replaces PETSc's function, which the session calls next after SLEPc has started.
extern "C" PetscErrorCode PetscPushErrorHandler(
    PetscErrorCode (* /*handler*/)(MPI_Comm, int, const char*, const char*, PetscErrorCode,
                                   PetscErrorType, const char*, void*),
    void* /*context*/) {
  return session_fails ? PETSC_ERR_LIB : 0;
}

int main(int argc, char** argv) {
  return argc > 1 && std::string_view(argv[1]) == "start" ? fail_at_start() : fail_on_a_rank();
}
