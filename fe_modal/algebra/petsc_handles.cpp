// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/petsc_handles.h"

#include <string>

#include "fe_modal/algebra/cholmod_handles.h"
#include "fe_modal/algebra/communicator.h"
#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {

void require(PetscErrorCode code, std::string_view doing) {
  if (code == 0) return;
  const char* text = nullptr;
  if (code == PETSC_ERR_MEM) throw out_of_memory(std::string(doing), kOrAnotherSolution);
  static_cast<void>(PetscErrorMessage(code, &text, nullptr));
  throw ComputationError("PETSc failed while " + std::string(doing) + ": " +
                         (text == nullptr ? "unknown error" : text) + " (code " +
                         std::to_string(static_cast<int>(code)) + ")");
}

VecHandle vector_on(std::span<const double> values, const Ranks& ranks) {
  VecHandle vector;
  const auto size = static_cast<PetscInt>(values.size());
  require(ranks.are_many()
              ? VecCreateMPIWithArray(communicator(ranks), 1, size, PETSC_DECIDE, values.data(),
                                      vector.out())
              : VecCreateSeqWithArray(communicator(ranks), 1, size, values.data(), vector.out()),
          "laying a vector on memory");
  return vector;
}

}  // namespace flexneck::fe_modal
