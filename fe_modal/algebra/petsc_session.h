// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

namespace flexneck::fe_modal {

/// Keeps PETSc, SLEPc and MPI initialised while it lives; all solvers need it. MPI can be
/// initialised once in a process: a session within the life of another one shares it, and after the
/// end of the outer one there can be none. One thread at a time may solve, whichever began the
/// session.
class PetscSession {
 public:
  PetscSession();
  ~PetscSession();
  PetscSession(const PetscSession&) = delete;
  PetscSession& operator=(const PetscSession&) = delete;

 private:
  struct Start {};
  explicit PetscSession(Start start);

  bool is_outer_ = true;  ///< the outer session finalises the libraries
};

/// Options of every session: CHOLMOD prints nothing for matrices that are not positive definite,
/// and uses the order of elimination that it is given (elimination_order.h).
inline constexpr const char* kSessionOptions = "-st_mat_cholmod_print 0 -st_mat_cholmod_nmethods 1";

/// PETSc's message of this thread's last error, returned once; empty if there is none.
std::string last_petsc_message();

/// Versions of the BLAS with its kernels, PETSc, SLEPc and SuiteSparse, for the provenance.
std::map<std::string, std::string> library_versions();

}  // namespace flexneck::fe_modal
