// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/petsc_session.h"

#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <map>
#include <set>
#include <string>
#include <unistd.h>
#include <utility>

#include <petscpkg_version.h>

#include "fe_modal/algebra/communicator.h"
#include "fe_modal/algebra/petsc_handles.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {

namespace {

/// Finds a function of the BLAS by its name; null if the BLAS is not OpenBLAS.
template <typename Function>
Function* find(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

std::string chosen_kernels() {
  const auto name = find<char*()>("openblas_get_corename");
  return name == nullptr ? "" : name();
}

/// Makes the calling thread run the BLAS and OpenMP on one thread: between the thousands of small
/// products of a factorisation threads wait for one another, and sums would come in another order
/// for each number of threads. Each session begins with this call.
void call_blas_alone() {
  for (const char* set_number : {"openblas_set_num_threads", "omp_set_num_threads"})
    if (const auto set = find<void(int)>(set_number)) set(1);
  // CHOLMOD asks for four threads wherever it asks for any, whatever the number of processors: with
  // zero levels of OpenMP allowed to be active it gets one.
  if (const auto set_levels = find<void(int)>("omp_set_max_active_levels")) set_levels(0);
}

/// Version and kernels of the BLAS, "OpenBLAS 0.3.21, SkylakeX", by which results differ in
/// rounding; "unknown" for another BLAS.
std::string blas_version() {
  const auto configuration = find<char*()>("openblas_get_config");
  if (configuration == nullptr) return "unknown";
  const std::string text = configuration();  // "OpenBLAS 0.3.21 NO_LAPACKE ..."
  const std::size_t end = text.find(' ', text.find(' ') + 1);
  return text.substr(0, end) + ", " + chosen_kernels();
}

/// Settings of Open MPI while MPI starts in a process that neither mpirun nor a batch system has
/// started: without them Open MPI would spend a third of a second on a daemon and on network
/// connections that are never used. Variables that the user has set stay; those that this class and
/// Open MPI set are removed again, or an mpirun that this process starts later would take itself
/// for a part of it.
class StartAlone {
 public:
  StartAlone() {
    for (const char* const launched : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"}) {
      if (std::getenv(launched) != nullptr) return;
    }
    is_alone_ = true;
    before_ = variables();
    set("OMPI_MCA_ess_singleton_isolated", "1");
    set("OMPI_MCA_btl", "self");
    set("OMPI_MCA_pml", "ob1");
    // A serial run shares no files. Two processes that create and remove the folder for shared
    // files at the same time would disturb each other.
    set("OMPI_MCA_orte_create_session_dirs", "0");
  }
  ~StartAlone() {
    if (!is_alone_) return;
    for (const std::string& name : variables())
      if (before_.count(name) == 0) unsetenv(name.c_str());
  }
  StartAlone(const StartAlone&) = delete;
  StartAlone& operator=(const StartAlone&) = delete;

 private:
  static void set(const char* name, const char* value) {
    constexpr int kKeepTheUsers = 0;
    setenv(name, value, kKeepTheUsers);
  }
  /// Names of the environment variables of MPI.
  static std::set<std::string> variables() {
    std::set<std::string> names;
    for (char** variable = environ; *variable != nullptr; ++variable) {
      const std::string name = std::string(*variable).substr(0, std::strcspn(*variable, "="));
      if (name.starts_with("OMPI_") || name.starts_with("PMIX_") || name.starts_with("OPAL_"))
        names.insert(name);
    }
    return names;
  }

  bool is_alone_ = false;
  std::set<std::string> before_;
};

/// PETSc's message of the last error.
std::string& petsc_message() {
  thread_local std::string message;
  return message;
}

/// Keeps the message: errors are returned as codes, without a trace on the terminal.
PetscErrorCode keep_message(MPI_Comm /*ranks*/, int /*line*/, const char* /*function*/,
                            const char* /*file*/, PetscErrorCode code, PetscErrorType type,
                            const char* message, void* /*context*/) {
  if (type == PETSC_ERROR_INITIAL) petsc_message() = message == nullptr ? "" : message;
  return code;
}

}  // namespace

std::string last_petsc_message() { return std::exchange(petsc_message(), {}); }

PetscSession::PetscSession(Start /*start*/) {
  PetscBool initialized = PETSC_FALSE;
  require(PetscInitialized(&initialized), "querying whether PETSc is initialised");
  if (initialized == PETSC_TRUE) {
    is_outer_ = false;
    return;
  }
  const StartAlone alone;
  call_blas_alone();
  int finalized = 0;
  require_mpi(MPI_Finalized(&finalized));
  if (finalized != 0) throw ComputationError("PETSc can be initialised only once per process");
  PETSC_MPI_THREAD_REQUIRED = MPI_THREAD_SERIALIZED;
  // The process keeps its signal handlers, and neither a user's .petscrc nor the environment nor
  // the command line affects the solvers: PETSc sees these arguments only. At its end it does not
  // report options of the session that were never asked for.
  unsetenv("PETSC_OPTIONS");
  char name[] = "flexneck";
  char no_signals[] = "-no_signal_handler";
  char no_petscrc[] = "-skip_petscrc";
  char options_left[] = "-options_left";
  char no[] = "no";
  char* arguments[] = {name, no_signals, no_petscrc, options_left, no, nullptr};
  char** argument_list = arguments;
  int argument_count = 5;
  const PetscErrorCode code = SlepcInitialize(&argument_count, &argument_list, nullptr, nullptr);
  if (code != 0) {  // SLEPc does not say how far it came, but MPI does
    int has_begun = 0;
    MPI_Initialized(&has_begun);
    if (has_begun != 0) MPI_Finalize();
  }
  require(code, "initialising PETSc");
}

// The constructor delegates, so that the session is finalised if the rest of it throws.
PetscSession::PetscSession() : PetscSession(Start()) {
  if (!is_outer_) return;
  PetscErrorPrintf = PetscErrorPrintfNone;
  require(PetscOptionsInsertString(nullptr, kSessionOptions), "setting options of PETSc");
  require(PetscPushErrorHandler(keep_message, nullptr), "setting the error handler of PETSc");
}

PetscSession::~PetscSession() {
  if (is_outer_) static_cast<void>(SlepcFinalize());
}

std::map<std::string, std::string> library_versions() {
  const auto join = [](int major, int minor, int patch) {
    return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
  };
  return {
      {"BLAS", blas_version()},
      {"MUMPS", join(PETSC_PKG_MUMPS_VERSION_MAJOR, PETSC_PKG_MUMPS_VERSION_MINOR,
                     PETSC_PKG_MUMPS_VERSION_SUBMINOR)},
      {"PETSc", join(PETSC_VERSION_MAJOR, PETSC_VERSION_MINOR, PETSC_VERSION_SUBMINOR)},
      {"SLEPc", join(SLEPC_VERSION_MAJOR, SLEPC_VERSION_MINOR, SLEPC_VERSION_SUBMINOR)},
      {"SuiteSparse", join(PETSC_PKG_SUITESPARSE_VERSION_MAJOR, PETSC_PKG_SUITESPARSE_VERSION_MINOR,
                           PETSC_PKG_SUITESPARSE_VERSION_SUBMINOR)},
  };
}

}  // namespace flexneck::fe_modal
