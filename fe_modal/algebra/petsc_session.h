// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

namespace flexneck::fe_modal {

/// Keeps PETSc and SLEPc (and MPI) initialised while it lives; one at a time. All that
/// solves needs it.
class PetscSession {
 public:
  PetscSession();
  ~PetscSession();
  PetscSession(const PetscSession&) = delete;
  PetscSession& operator=(const PetscSession&) = delete;

 private:
  struct Start {};
  explicit PetscSession(Start start);
};

/// Versions of PETSc, SLEPc and MUMPS, for the provenance.
std::map<std::string, std::string> library_versions();

}  // namespace flexneck::fe_modal
