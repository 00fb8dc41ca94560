// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <exception>
#include <utility>

#include "fe_modal/algebra/petsc_handles.h"

namespace flexneck::fe_modal {

/// Carries an exception past the C frames of PETSc and SLEPc, which it must not cross: the function
/// that they call keeps it and returns an error code, and the caller of PETSc throws it again.
class KeptException {
 public:
  /// Runs the work of a function that PETSc calls.
  /// @return 0, or an error code if `work` has thrown
  template <typename Work>
  PetscErrorCode keep(Work&& work) noexcept {
    try {
      std::forward<Work>(work)();
      return 0;
    } catch (...) {
      kept_ = std::current_exception();
      return PETSC_ERR_LIB;
    }
  }

  /// Throws the kept exception, once; for use after a call of PETSc.
  void rethrow() {
    if (kept_) std::rethrow_exception(std::exchange(kept_, nullptr));
  }

 private:
  std::exception_ptr kept_;
};

}  // namespace flexneck::fe_modal
