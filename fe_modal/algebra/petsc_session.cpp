// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/petsc_session.h"

#include <cstdlib>
#include <malloc.h>
#include <map>
#include <string>

#include <petscpkg_version.h>

#include "fe_modal/algebra/petsc_handles.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {

namespace {

/// In a process that neither mpirun nor a batch system has started, Open MPI would spend a third of
/// a second on a daemon and on network connections that are never used.
void stay_alone() {
  for (const char* const launched : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"}) {
    if (std::getenv(launched) != nullptr) return;
  }
  constexpr int kKeepTheUsers = 0;
  setenv("OMPI_MCA_ess_singleton_isolated", "1", kKeepTheUsers);
  setenv("OMPI_MCA_btl", "self", kKeepTheUsers);
  setenv("OMPI_MCA_pml", "ob1", kKeepTheUsers);
  // Alone it shares no files. Two processes at once that make and remove the folder for them get in
  // each other's way.
  setenv("OMPI_MCA_orte_create_session_dirs", "0", kKeepTheUsers);
}

/// Arrays from a megabyte on go back to the system as soon as they are freed. By default glibc
/// keeps ever larger ones, in pieces that the next do not fit in: a twentieth of the peak on two
/// ranks.
void give_memory_back() {
  constexpr int kLeastBytes = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, kLeastBytes);
}

}  // namespace

PetscSession::PetscSession(Start /*start*/) {
  stay_alone();
  give_memory_back();
  int finalized = 0;
  MPI_Finalized(&finalized);
  PetscBool initialized = PETSC_FALSE;
  require(PetscInitialized(&initialized), "asking whether PETSc is initialised");
  if (finalized != 0 || initialized == PETSC_TRUE) {
    throw ComputationError("PETSc can be initialised once in a process only");
  }
  // The process keeps its signal handlers, and neither a user's .petscrc nor the environment nor
  // the command line steers the solvers: PETSc sees these arguments only.
  unsetenv("PETSC_OPTIONS");
  char name[] = "flexneck";
  char no_signals[] = "-no_signal_handler";
  char no_petscrc[] = "-skip_petscrc";
  char* arguments[] = {name, no_signals, no_petscrc, nullptr};
  char** argument_list = arguments;
  int argument_count = 3;
  const PetscErrorCode code = SlepcInitialize(&argument_count, &argument_list, nullptr, nullptr);
  if (code != 0) {  // how far they came they do not say, but MPI does
    int has_begun = 0;
    MPI_Initialized(&has_begun);
    if (has_begun != 0) MPI_Finalize();
  }
  require(code, "initialising PETSc");
}

// A constructor that delegates ends like any object if what comes after throws: finalised.
PetscSession::PetscSession() : PetscSession(Start()) {
  // Errors come back as codes, without a trace on the terminal, nor what CHOLMOD says of them.
  PetscErrorPrintf = PetscErrorPrintfNone;
  require(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr), "silencing PETSc");
  require(PetscOptionsSetValue(nullptr, "-mat_cholmod_print", "0"), "silencing CHOLMOD");
  const std::string given = "-" + std::string(kGivenOrderPrefix);
  require(PetscOptionsSetValue(nullptr, (given + "mat_cholmod_print").c_str(), "0"),
          "silencing CHOLMOD");
  // Left to itself CHOLMOD also tries orders of its own and keeps the one it likes best.
  require(PetscOptionsSetValue(nullptr, (given + "mat_cholmod_nmethods").c_str(), "1"),
          "telling CHOLMOD to keep a given order");
}

PetscSession::~PetscSession() { static_cast<void>(SlepcFinalize()); }

std::map<std::string, std::string> library_versions() {
  const auto join = [](int major, int minor, int patch) {
    return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
  };
  return {
      {"PETSc", join(PETSC_VERSION_MAJOR, PETSC_VERSION_MINOR, PETSC_VERSION_SUBMINOR)},
      {"SLEPc", join(SLEPC_VERSION_MAJOR, SLEPC_VERSION_MINOR, SLEPC_VERSION_SUBMINOR)},
      {"SuiteSparse", join(PETSC_PKG_SUITESPARSE_VERSION_MAJOR, PETSC_PKG_SUITESPARSE_VERSION_MINOR,
                           PETSC_PKG_SUITESPARSE_VERSION_SUBMINOR)},
  };
}

}  // namespace flexneck::fe_modal
