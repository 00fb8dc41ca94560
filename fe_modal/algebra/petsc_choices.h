// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <petscsys.h>

namespace flexneck::fe_modal {

/// Beginnings of the names of options of PETSc and SLEPc that a user may choose: those that affect
/// the method of solution, not the problem.
std::vector<std::string> petsc_choice_prefixes();

/// A user's options of PETSc and SLEPc, such as "-eps_ncv 40 -st_mat_mumps_icntl_14 50", in effect
/// while this lives. All others, from the environment or a file, are without effect.
class PetscChoices {
 public:
  /// @throws InputError for an option that may not be chosen.
  explicit PetscChoices(const std::string& options);
  ~PetscChoices();
  PetscChoices(const PetscChoices&) = delete;
  PetscChoices& operator=(const PetscChoices&) = delete;

  /// @throws InputError for options that no solver has asked for.
  void require_used() const;

 private:
  PetscOptions options_ = nullptr;  ///< null if there are no options
};

}  // namespace flexneck::fe_modal
