// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

namespace flexneck::fe_modal {

/// Keeps PETSc and SLEPc (and MPI) initialised while it lives. All that solves needs it. MPI begins
/// once in a process: a session within the life of another one shares it, after the end of that one
/// there is none. One thread at a time may solve, whichever began it.
class PetscSession {
 public:
  PetscSession();
  ~PetscSession();
  PetscSession(const PetscSession&) = delete;
  PetscSession& operator=(const PetscSession&) = delete;

 private:
  struct Start {};
  explicit PetscSession(Start start);

  bool is_outer_ = true;  ///< which ends what it has begun
};

/// Options of every session: CHOLMOD prints nothing of matrices that are not positive definite, and
/// takes the order of elimination that it is given (elimination_order.h).
inline constexpr const char* kSessionOptions = "-st_mat_cholmod_print 0 -st_mat_cholmod_nmethods 1";

/// What PETSc said of this thread's last error, once; empty if it said nothing.
std::string last_petsc_message();

/// Versions of the BLAS with its kernels, PETSc, SLEPc and SuiteSparse, for the provenance.
std::map<std::string, std::string> library_versions();

}  // namespace flexneck::fe_modal
