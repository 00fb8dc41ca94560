// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/petsc_choices.h"

#include <sstream>

#include "fe_modal/algebra/petsc_handles.h"
#include "fe_modal/algebra/petsc_session.h"
#include "geometry/foundation/ascii.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kTaking = "setting options of PETSc";

bool is_name(const std::string& word) {
  return word.size() > 1 && word[0] == '-' && is_letter(word[1]);
}

void check_name(const std::string& word) {
  if (word == "-st_pc_factor_mat_solver_type")
    throw InputError("the option " + word +
                     " of PETSc is not allowed; choose the solver with modes.solver");
  const std::vector<std::string> prefixes = petsc_choice_prefixes();
  std::string all;
  for (const std::string& prefix : prefixes) {
    if (word.starts_with(prefix)) return;
    all += (all.empty() ? "" : ", ") + prefix;
  }
  throw InputError("the option " + word +
                   " of PETSc is not allowed; expected names that begin with " + all);
}

}  // namespace

std::vector<std::string> petsc_choice_prefixes() {
  return {"-eps_ncv",           "-eps_mpd",       "-eps_max_it",     "-st_ksp_",
          "-st_pc_factor_mat_", "-st_mat_mumps_", "-st_mat_cholmod_"};
}

PetscChoices::PetscChoices(const std::string& options) {
  std::istringstream words(options);
  bool is_first = true;
  for (std::string word; words >> word; is_first = false) {
    if (is_name(word)) {
      check_name(word);
    } else if (is_first) {
      throw InputError("options of PETSc: expected an option such as -eps_ncv, found '" + word +
                       "'");
    }
  }
  if (is_first) return;
  require(PetscOptionsCreate(&options_), kTaking);
  require(PetscOptionsInsertString(options_, kSessionOptions), kTaking);
  require(PetscOptionsInsertString(options_, options.c_str()), kTaking);
  require(PetscOptionsPush(options_), kTaking);
}

PetscChoices::~PetscChoices() {
  if (options_ == nullptr) return;
  static_cast<void>(PetscOptionsPop());
  static_cast<void>(PetscOptionsDestroy(&options_));
}

void PetscChoices::require_used() const {
  if (options_ == nullptr) return;
  PetscInt count = 0;
  char** names = nullptr;
  char** values = nullptr;
  require(PetscOptionsLeftGet(options_, &count, &names, &values), kTaking);
  std::string left;
  for (PetscInt k = 0; k < count; ++k) {
    const std::string name = "-" + std::string(names[k]);
    const bool is_ours = std::string(kSessionOptions).find(name + " ") != std::string::npos;
    if (!is_ours) left += (left.empty() ? "" : ", ") + name;
  }
  require(PetscOptionsLeftRestore(options_, &count, &names, &values), kTaking);
  if (!left.empty())
    throw InputError("PETSc options without effect: " + left +
                     "; the solver and the method in use do not have these options");
}

}  // namespace flexneck::fe_modal
